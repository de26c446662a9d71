#include "engine/extract/cost/sample.h"

#include <algorithm>

#include "engine/extract/cost/cover.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// A face stands for this many points, spread evenly over it: the centroids of its parts when every side is
// cut into kCuts.
constexpr int kCuts = 4;
constexpr int kPoints = kCuts * kCuts;

std::int64_t voxel_of(std::int64_t lattice) {
  return (lattice + survey::kLatticePerVoxel / 2) >> 8;
}
static_assert(survey::kLatticePerVoxel == 1 << 8);

// Calls visit(voxel) for the voxels under the points.
template <typename Visit>
void for_each_point(const survey::LatticeTriangle& t, Visit&& visit) {
  constexpr std::int64_t kThirds = std::int64_t{3} * kCuts;
  const survey::Index a{t[0].i, t[0].j, t[0].k};
  const survey::Index b{t[1].i, t[1].j, t[1].k};
  const survey::Index c{t[2].i, t[2].j, t[2].k};
  const auto at = [&](std::int64_t u, std::int64_t v) {  // in thirds of a part
    survey::Index voxel{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      voxel[axis] = voxel_of(a[axis] + ((b[axis] - a[axis]) * u + (c[axis] - a[axis]) * v) / kThirds);
    visit(voxel);
  };
  for (std::int64_t row = 0; row < kCuts; ++row) {
    for (std::int64_t n = 0; row + n < kCuts; ++n) {
      at(3 * n + 1, 3 * row + 1);
      if (row + n < kCuts - 1) at(3 * n + 2, 3 * row + 2);
    }
  }
}

// 1 - exp(-x), for x >= 0, by multiplications alone: the same bits everywhere.
double filled(double x) {
  constexpr int kSquarings = 6;
  double power = 1 / (1 + x / (1 << kSquarings));
  for (int n = 0; n < kSquarings; ++n) power *= power;
  return 1 - power;
}

// How many of `volume` voxels are hit where `hits` fall on them at random.
double distinct(double hits, double volume) {
  return volume > 0 ? volume * filled(hits / volume) : 0;
}

// Which pairs of ranks there are.
class PairSet {
 public:
  explicit PairSet(std::size_t ranks) : ranks_(ranks), words_((ranks * ranks + 63) / 64, 0) {}
  // Whether it is new.
  bool insert(std::size_t from, std::size_t to) {
    const std::size_t bit = from * ranks_ + to;
    const std::uint64_t mask = std::uint64_t{1} << (bit % 64);
    const bool is_new = (words_[bit / 64] & mask) == 0;
    words_[bit / 64] |= mask;
    return is_new;
  }

 private:
  std::size_t ranks_;
  std::vector<std::uint64_t> words_;
};

}  // namespace

std::vector<std::int64_t> expected_voxels(std::span<const Face> faces, const survey::Index& dims) {
  const survey::Box survey{{0, 0, 0}, dims};
  std::vector<std::int64_t> voxels;
  voxels.reserve(faces.size());
  for (const Face& face : faces) {
    double cover = expected_cover(shape_of(face.triangle), {1, 1, 1});
    const bool inside = std::all_of(face.triangle.begin(), face.triangle.end(), [&](const auto& p) {
      return survey.contains({voxel_of(p.i), voxel_of(p.j), voxel_of(p.k)});
    });
    if (!inside) {
      int points = 0;
      for_each_point(face.triangle,
                     [&](const survey::Index& voxel) { points += survey.contains(voxel) ? 1 : 0; });
      cover = cover * points / kPoints;
    }
    // More than there are voxels nobody can have.
    const auto most = static_cast<double>(survey.count());
    voxels.push_back(static_cast<std::int64_t>(std::min(cover, most) + 0.5));
  }
  return voxels;
}

FaceSample::FaceSample(const comm::RankGrid& grid, std::span<const Face> faces, int reach, std::size_t most)
    : ranks_(static_cast<std::size_t>(grid.ranks())), faces_(faces.size()), volumes_(ranks_, 0) {
  for (std::size_t rank = 0; rank < ranks_; ++rank) {
    for (const survey::Box& box : grid.boxes(static_cast<int>(rank)))
      volumes_[rank] += static_cast<double>(box.count());
  }
  const std::size_t taken = std::min(most, faces.size());
  if (taken == 0) return;
  scale_ = static_cast<double>(faces.size()) / static_cast<double>(taken);
  for (std::size_t n = 0; n < taken; ++n) {
    // A step that changes from face to face, so that the order of the input has no part in it.
    const std::size_t first = n * faces.size() / taken;
    const std::size_t next = (n + 1) * faces.size() / taken;
    const std::size_t face = first + (n * std::size_t{2654435761} >> 7) % (next - first);
    add(grid, face, faces[face].triangle, reach);
  }
}

void FaceSample::add(const comm::RankGrid& grid, std::size_t face, const survey::LatticeTriangle& triangle,
                     int reach) {
  const survey::Box survey{{0, 0, 0}, grid.dims()};
  const Shape shape = shape_of(triangle);
  const double wide = 1 + 2.0 * reach;
  const double voxels = expected_cover(shape, {1, 1, 1});
  const double needed = expected_cover(shape, {wide, wide, 1});
  const std::size_t begin = pieces_.size();
  const auto piece_of = [&](int owner) -> Piece& {
    const auto found = std::find_if(pieces_.begin() + static_cast<std::ptrdiff_t>(begin), pieces_.end(),
                                    [&](const Piece& piece) { return piece.owner == owner; });
    if (found != pieces_.end()) return *found;
    Piece piece;
    piece.face = face;
    piece.owner = owner;
    return pieces_.emplace_back(piece);
  };
  for_each_point(triangle, [&](const survey::Index& voxel) {
    if (!survey.contains(voxel)) return;
    Piece& piece = piece_of(grid.owner(voxel));
    piece.voxels += voxels / kPoints;
    piece.needed += needed / kPoints;
    for (std::size_t n = 0; n < kBlockSides.size(); ++n) {
      const double side = kBlockSides[n];
      piece.blocks[n] += expected_cover(shape, {wide + side - 1, wide + side - 1, side}) / kPoints;
    }
  });
  // The bounding volume, cut along the pillars.
  survey::Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = [&](std::size_t n) {
      const survey::LatticePoint& p = triangle[n];
      return std::int64_t{axis == 0 ? p.i : axis == 1 ? p.j : p.k};
    };
    const std::int64_t around = axis < 2 ? reach : 0;
    box.lo[axis] = voxel_of(std::min({value(0), value(1), value(2)})) - around;
    box.hi[axis] = voxel_of(std::max({value(0), value(1), value(2)})) + 1 + around;
  }
  box = survey::intersection(box, survey);
  if (box.empty()) return;
  const auto [along_i, along_j] = grid.lines();
  for (std::int64_t i = box.lo[0] / along_i; i * along_i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1] / along_j; j * along_j < box.hi[1]; ++j) {
      const survey::Box pillar{{i * along_i, j * along_j, 0},
                               {(i + 1) * along_i, (j + 1) * along_j, grid.dims()[2]}};
      const survey::Box part = survey::intersection(box, pillar);
      piece_of(grid.owner(part.lo)).bounding += static_cast<double>(part.count());
    }
  }
}

std::vector<RankAmounts> FaceSample::amounts(std::span<const int> responsible,
                                             std::span<const std::int64_t> voxels) const {
  require(responsible.size() == faces_ && voxels.size() == faces_,
          "a rank and a number of voxels for every face");
  std::vector<RankAmounts> ranks(ranks_);
  for (std::size_t n = 0; n < faces_; ++n) {
    RankAmounts& rank = ranks[static_cast<std::size_t>(responsible[n])];
    rank.faces += 1;
    rank.voxels += static_cast<double>(voxels[n]);
  }
  PairSet pairs(ranks_);
  std::vector<double> volume_received(ranks_, 0);  // of the ranks that it hears from
  for (const Piece& piece : pieces_) {
    const auto to = static_cast<std::size_t>(responsible[piece.face]);
    const auto from = static_cast<std::size_t>(piece.owner);
    RankAmounts& owner = ranks[from];
    RankAmounts& receiver = ranks[to];
    owner.owned += scale_ * piece.voxels;
    if (piece.voxels > 0) owner.owned_faces += scale_;
    if (from == to) continue;
    owner.owned_elsewhere += scale_ * piece.voxels;
    owner.sent += scale_ * piece.needed;
    receiver.received += scale_ * piece.needed;
    for (std::size_t n = 0; n < kBlockSides.size(); ++n) {
      owner.blocks_sent[n] += scale_ * piece.blocks[n];
      receiver.blocks_received[n] += scale_ * piece.blocks[n];
    }
    owner.bounding_sent += scale_ * piece.bounding;
    receiver.bounding_received += scale_ * piece.bounding;
    if (piece.voxels > 0) {
      owner.pieces_sent += scale_;
      receiver.pieces_received += scale_;
    }
    if (pairs.insert(from, to)) {
      owner.partners_sent += 1;
      receiver.partners_received += 1;
      volume_received[to] += volumes_[from];
    }
  }
  // A voxel goes to a rank once, however many of its faces cut it.
  for (std::size_t n = 0; n < ranks_; ++n) {
    RankAmounts& rank = ranks[n];
    const double volume_sent = volumes_[n] * rank.partners_sent;
    for (double* sent : {&rank.sent, &rank.blocks_sent[0], &rank.blocks_sent[1], &rank.bounding_sent})
      *sent = distinct(*sent, volume_sent);
    for (double* received :
         {&rank.received, &rank.blocks_received[0], &rank.blocks_received[1], &rank.bounding_received})
      *received = distinct(*received, volume_received[n]);
  }
  return ranks;
}

}  // namespace footwall::extract
