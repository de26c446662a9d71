#include "engine/extract/balance/cache_directory.h"

#include <algorithm>

#include "engine/voxelize/exact.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// A triangle seen along the samples, in lattice units.
struct Flat {
  std::array<std::int64_t, 3> x{};
  std::array<std::int64_t, 3> y{};
};

// Whether the closed rectangle [x0,x1] x [y0,y1] meets the flat triangle: no edge has all of the rectangle
// strictly on its outer side. (The triangle's own bounding box has been looked at before.)
bool meets(const Flat& t, std::int64_t x0, std::int64_t x1, std::int64_t y0, std::int64_t y1) {
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t m = (n + 1) % 3;
    const std::size_t other = (n + 2) % 3;
    // Normal of the edge n -> m. Differences have 33 bits at most: products are taken in 128.
    __extension__ typedef __int128 Int128;
    const Int128 nx = t.y[n] - t.y[m];
    const Int128 ny = t.x[m] - t.x[n];
    const Int128 inner = nx * (t.x[other] - t.x[n]) + ny * (t.y[other] - t.y[n]);
    Int128 least = 0;
    Int128 most = 0;
    bool first = true;
    for (const std::int64_t x : {x0, x1}) {
      for (const std::int64_t y : {y0, y1}) {
        const Int128 side = nx * (x - t.x[n]) + ny * (y - t.y[n]);
        least = first ? side : std::min(least, side);
        most = first ? side : std::max(most, side);
        first = false;
      }
    }
    if (least > std::max<Int128>(0, inner) || most < std::min<Int128>(0, inner)) return false;
  }
  return true;
}

}  // namespace

CacheDirectory::CacheDirectory(const comm::RankGrid& grid, std::int64_t most_bytes) : grid_(grid) {
  require(most_bytes >= 0, "room for the directory");
  for (;; cell_ *= 2) {
    for (std::size_t axis = 0; axis < 2; ++axis) cells_[axis] = (grid.dims()[axis] + cell_ - 1) / cell_;
    words_per_row_ = static_cast<std::size_t>((cells_[1] + 63) / 64);
    const std::int64_t words = grid.ranks() * cells_[0] * static_cast<std::int64_t>(words_per_row_);
    if (words * 8 > most_bytes && (cells_[0] > 1 || cells_[1] > 1)) continue;
    words_.assign(static_cast<std::size_t>(words), 0);
    return;
  }
}

void CacheDirectory::add(std::span<const Face> faces, std::span<const int> responsible) {
  require(faces.size() == responsible.size(), "a rank for every face");
  for (std::size_t n = 0; n < faces.size(); ++n) {
    if (responsible[n] < 0) continue;
    require(responsible[n] < grid_.ranks(), "a rank of the grid");
    mark(faces[n].triangle, responsible[n]);
  }
}

void CacheDirectory::mark(const survey::LatticeTriangle& triangle, int rank) {
  const survey::Box box =
      survey::intersection(voxelize::bounding_voxels(triangle), {{0, 0, 0}, grid_.dims()});
  if (box.empty()) return;
  const Flat flat{{triangle[0].i, triangle[1].i, triangle[2].i},
                  {triangle[0].j, triangle[1].j, triangle[2].j}};
  constexpr std::int64_t kVoxel = survey::kLatticePerVoxel;
  for (std::int64_t a = box.lo[0] / cell_; a <= (box.hi[0] - 1) / cell_; ++a) {
    for (std::int64_t b = box.lo[1] / cell_; b <= (box.hi[1] - 1) / cell_; ++b) {
      // The traces of this cell that the face may cut.
      const std::int64_t i0 = std::max(box.lo[0], a * cell_);
      const std::int64_t i1 = std::min(box.hi[0], (a + 1) * cell_) - 1;
      const std::int64_t j0 = std::max(box.lo[1], b * cell_);
      const std::int64_t j1 = std::min(box.hi[1], (b + 1) * cell_) - 1;
      const auto [rows, columns] = grid_.lines();
      const bool in_one_pillar = i0 / rows == i1 / rows && j0 / columns == j1 / columns;
      if (in_one_pillar && grid_.owner({i0, j0, 0}) == rank) continue;  // its own: never received
      if (!meets(flat, i0 * kVoxel - kVoxel / 2, i1 * kVoxel + kVoxel / 2, j0 * kVoxel - kVoxel / 2,
                 j1 * kVoxel + kVoxel / 2)) {
        continue;
      }
      words_[word(a, b, rank)] |= std::uint64_t{1} << (b % 64);
      empty_ = false;
    }
  }
}

void CacheDirectory::clear() {
  std::fill(words_.begin(), words_.end(), 0);
  empty_ = true;
}

bool CacheDirectory::holds(int rank, const survey::Box& box) const {
  const survey::Box inside = survey::intersection(box, {{0, 0, 0}, grid_.dims()});
  if (inside.empty() || empty_) return false;
  const std::int64_t b0 = inside.lo[1] / cell_;
  const std::int64_t b1 = (inside.hi[1] - 1) / cell_;
  for (std::int64_t a = inside.lo[0] / cell_; a <= (inside.hi[0] - 1) / cell_; ++a) {
    for (std::int64_t b = b0; b <= b1; ++b) {
      if ((words_[word(a, b, rank)] >> (b % 64) & 1) != 0) return true;
    }
  }
  return false;
}

}  // namespace footwall::extract
