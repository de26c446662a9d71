#include "ui/model/voxel_bricks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

namespace footwall::ui {
namespace {

using survey::IndexPoint;

constexpr float kNull = std::numeric_limits<float>::quiet_NaN();
// Samples by which a brick is taken for one that the surface passes through: the graphics card counts in
// floats.
constexpr double kNear = 0.02;

double axis(const IndexPoint& p, int n) {
  return n == 0 ? p.i : n == 1 ? p.j : p.k;
}

IndexPoint middle(const IndexPoint& a, const IndexPoint& b) {
  return {(a.i + b.i) / 2, (a.j + b.j) / 2, (a.k + b.k) / 2};
}

class Passing {
 public:
  Passing(const survey::Index& sampled, const survey::Index& bricks) : sampled_(sampled), bricks_(bricks) {}

  // Corners in samples of the bricks' step. A triangle that spans several bricks is halved at its longest
  // edge.
  void add(const IndexPoint& a, const IndexPoint& b, const IndexPoint& c) {
    std::array<std::int64_t, 3> lo{}, hi{};
    bool small = true;
    for (int n = 0; n < 3; ++n) {
      const auto [least, most] = std::minmax({axis(a, n), axis(b, n), axis(c, n)});
      const auto last = static_cast<double>(sampled_[n] - 1);
      if (!(most > -0.5 - kNear) || !(least < last + 0.5 + kNear)) return;
      const auto brick = [&](double at) {
        const auto cell = static_cast<std::int64_t>(std::clamp(at, 0.0, last));
        return std::min(cell / VoxelBricks::kCells, bricks_[n] - 1);
      };
      lo[static_cast<std::size_t>(n)] = brick(least - kNear);
      hi[static_cast<std::size_t>(n)] = brick(most + kNear);
      small = small && (lo[static_cast<std::size_t>(n)] == hi[static_cast<std::size_t>(n)] ||
                        most - least <= static_cast<double>(VoxelBricks::kCells) / 2);
    }
    if (!small) return halve(a, b, c);
    for (std::int64_t i = lo[0]; i <= hi[0]; ++i) {
      for (std::int64_t j = lo[1]; j <= hi[1]; ++j) {
        for (std::int64_t k = lo[2]; k <= hi[2]; ++k) {
          const auto key = static_cast<std::uint32_t>((i * bricks_[1] + j) * bricks_[2] + k);
          if (keys_.empty() || keys_.back() != key) keys_.push_back(key);
        }
      }
    }
    if (keys_.size() > 2 * tidy_) tidy();
  }

  std::vector<std::uint32_t> keys() {
    tidy();
    return std::move(keys_);
  }

 private:
  void halve(const IndexPoint& a, const IndexPoint& b, const IndexPoint& c) {
    const auto length = [](const IndexPoint& p, const IndexPoint& q) {
      return std::hypot(p.i - q.i, p.j - q.j, p.k - q.k);
    };
    const double ab = length(a, b), bc = length(b, c), ca = length(c, a);
    if (ab >= bc && ab >= ca) {
      add(a, middle(a, b), c);
      add(middle(a, b), b, c);
    } else if (bc >= ca) {
      add(a, b, middle(b, c));
      add(a, middle(b, c), c);
    } else {
      add(a, b, middle(c, a));
      add(middle(c, a), b, c);
    }
  }
  void tidy() {
    std::ranges::sort(keys_);
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    tidy_ = std::max(tidy_, keys_.size());
  }

  survey::Index sampled_, bricks_;
  std::vector<std::uint32_t> keys_;
  std::size_t tidy_ = 4096;  // keys after the last tidying
};

void make_table(VoxelBricks& bricks, const std::vector<std::uint32_t>& keys) {
  bricks.table.assign(std::bit_ceil(std::max<std::size_t>(2 * keys.size(), 2)), {VoxelBricks::kFree, 0});
  for (std::size_t n = 0; n < keys.size(); ++n) {
    std::size_t slot = bricks.slot_of(keys[n]);
    int tries = 1;
    for (; bricks.table[slot][0] != VoxelBricks::kFree; ++tries) slot = (slot + 1) % bricks.table.size();
    bricks.longest = std::max(bricks.longest, tries);
    bricks.table[slot] = {keys[n], static_cast<std::uint32_t>(n)};
  }
}

// The first and last sample of a brick, as the volume counts them, cut at its end.
survey::Box box_of(const VoxelBricks& bricks, std::uint32_t key) {
  const survey::Index counts = bricks.bricks();
  const std::array<std::int64_t, 3> place{key / (counts[1] * counts[2]), key / counts[2] % counts[1],
                                          key % counts[2]};
  survey::Box box;
  for (int n = 0; n < 3; ++n) {
    box.lo[n] = place[static_cast<std::size_t>(n)] * VoxelBricks::kCells * bricks.step;
    box.hi[n] = std::min(bricks.size[n], box.lo[n] + VoxelBricks::kCells * bricks.step + 1);
  }
  return box;
}

// What of a chunk belongs to a brick.
void copy_part(const VoxelBricks& bricks, const survey::Box& brick, const survey::Box& chunk,
               const std::vector<float>& values, float* out) {
  const std::int64_t step = bricks.step;
  std::array<std::int64_t, 3> first{}, last{};
  for (std::size_t n = 0; n < 3; ++n) {
    const int at = static_cast<int>(n);
    const std::int64_t lo = std::max(brick.lo[at], chunk.lo[at]) - brick.lo[at];
    first[n] = (lo + step - 1) / step;
    last[n] = (std::min(brick.hi[at], chunk.hi[at]) - 1 - brick.lo[at]) / step;
  }
  for (std::int64_t i = first[0]; i <= last[0]; ++i) {
    for (std::int64_t j = first[1]; j <= last[1]; ++j) {
      // Of the brick's own first sample in this row, which may lie before the chunk.
      const std::int64_t row =
          ((brick.lo[0] + i * step - chunk.lo[0]) * chunk.size(1) + brick.lo[1] + j * step - chunk.lo[1]) *
              chunk.size(2) +
          brick.lo[2] - chunk.lo[2];
      float* to = out + (i * VoxelBricks::kSide + j) * VoxelBricks::kSide;
      for (std::int64_t k = first[2]; k <= last[2]; ++k)
        to[k] = values[static_cast<std::size_t>(row + k * step)];
    }
  }
}

}  // namespace

survey::Index VoxelBricks::sampled() const {
  survey::Index counts{};
  for (int n = 0; n < 3; ++n) counts[n] = (size[n] - 1) / step + 1;
  return counts;
}

survey::Index VoxelBricks::bricks() const {
  survey::Index counts = sampled();
  for (int n = 0; n < 3; ++n) counts[n] = std::max<std::int64_t>(1, (counts[n] - 1 + kCells - 1) / kCells);
  return counts;
}

std::uint32_t VoxelBricks::slot_of(std::uint32_t key) const {
  return (key * 2654435769U) >> (32 - std::countr_zero(table.size()));
}

const float* VoxelBricks::find(std::uint32_t key) const {
  if (table.empty()) return nullptr;
  std::size_t slot = slot_of(key);
  for (int tries = 0; tries < longest; ++tries, slot = (slot + 1) % table.size()) {
    if (table[slot][0] == key) return samples.data() + table[slot][1] * static_cast<std::size_t>(kSamples);
  }
  return nullptr;
}

std::optional<float> VoxelBricks::nearest(const IndexPoint& place) const {
  const survey::Index counts = bricks();
  const survey::Index all = sampled();
  std::uint32_t key = 0;
  std::array<std::int64_t, 3> in_brick{};
  for (int n = 0; n < 3; ++n) {
    const double at = axis(place, n) - static_cast<double>(origin[n]);
    if (!(at >= -0.5 && at <= static_cast<double>(size[n]) - 0.5)) return kNull;
    const double sample = std::clamp(at / static_cast<double>(step), 0.0, static_cast<double>(all[n] - 1));
    const std::int64_t brick = std::min(static_cast<std::int64_t>(sample) / kCells, counts[n] - 1);
    key = key * static_cast<std::uint32_t>(counts[n]) + static_cast<std::uint32_t>(brick);
    in_brick[static_cast<std::size_t>(n)] =
        static_cast<std::int64_t>(std::floor(sample - static_cast<double>(brick * kCells) + 0.5));
  }
  const float* values = find(key);
  if (values == nullptr) return {};
  return values[(in_brick[0] * kSide + in_brick[1]) * kSide + in_brick[2]];
}

std::vector<std::uint32_t> passed_bricks(const FaultSurface& surface, const survey::Geometry& survey,
                                         const VoxelBricks& bricks) {
  std::vector<IndexPoint> places;
  places.reserve(surface.vertices.size());
  const auto step = static_cast<double>(bricks.step);
  for (const survey::WorldPoint& vertex : surface.vertices) {
    const IndexPoint p = survey.index_of(vertex);
    places.push_back({(p.i - static_cast<double>(bricks.origin[0])) / step,
                      (p.j - static_cast<double>(bricks.origin[1])) / step,
                      (p.k - static_cast<double>(bricks.origin[2])) / step});
  }
  Passing passing(bricks.sampled(), bricks.bricks());
  for (const project::MeshFace& face : surface.faces) {
    const auto corner = [&](std::size_t n) { return places.at(static_cast<std::size_t>(face.vertices[n])); };
    const auto finite = [](const IndexPoint& p) {
      constexpr double kFar = 1e7;  // halving to bricks must end
      return std::abs(p.i) < kFar && std::abs(p.j) < kFar && std::abs(p.k) < kFar;
    };
    if (finite(corner(0)) && finite(corner(1)) && finite(corner(2)))
      passing.add(corner(0), corner(1), corner(2));
  }
  return passing.keys();
}

std::optional<VoxelBricks> read_bricks(const volume::VolumeReader& reader, Id volume,
                                       const survey::Index& origin, const survey::Geometry& survey,
                                       const FaultSurface& surface, std::size_t most,
                                       const VoxelBricks* known, const std::function<bool()>& stop) {
  VoxelBricks bricks{.volume = volume,
                     .step = 1,
                     .origin = origin,
                     .size = reader.info().dims,
                     .table = {},
                     .longest = 0,
                     .samples = {}};
  std::vector<std::uint32_t> keys = passed_bricks(surface, survey, bricks);
  // From some step on a volume is one brick.
  while (keys.size() > std::max<std::size_t>(most, 1)) {
    bricks.step *= 2;
    keys = passed_bricks(surface, survey, bricks);
  }
  make_table(bricks, keys);
  bricks.samples.assign(keys.size() * VoxelBricks::kSamples, kNull);
  const bool same = known != nullptr && known->volume == volume && known->step == bricks.step &&
                    known->origin == origin && known->size == bricks.size;
  // 1. What is known, and which chunks hold the rest.
  const survey::Index chunk_size = reader.info().chunk;
  std::map<std::array<std::int64_t, 3>, std::vector<std::size_t>> by_chunk;
  for (std::size_t n = 0; n < keys.size(); ++n) {
    if (const float* values = same ? known->find(keys[n]) : nullptr) {
      std::copy_n(values, VoxelBricks::kSamples, bricks.samples.data() + n * VoxelBricks::kSamples);
      continue;
    }
    const survey::Box box = box_of(bricks, keys[n]);
    for (std::int64_t i = box.lo[0] / chunk_size[0]; i * chunk_size[0] < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1] / chunk_size[1]; j * chunk_size[1] < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2] / chunk_size[2]; k * chunk_size[2] < box.hi[2]; ++k)
          by_chunk[{i, j, k}].push_back(n);
      }
    }
  }
  // 2. Chunk by chunk, into all bricks that it touches.
  std::vector<float> values;
  for (const auto& [place, wanted] : by_chunk) {
    if (stop()) return {};
    survey::Box chunk;
    for (int n = 0; n < 3; ++n) {
      chunk.lo[n] = place[static_cast<std::size_t>(n)] * chunk_size[n];
      chunk.hi[n] = std::min(bricks.size[n], chunk.lo[n] + chunk_size[n]);
    }
    values.resize(static_cast<std::size_t>(chunk.count()));
    reader.read(chunk, values);
    for (const std::size_t n : wanted) {
      copy_part(bricks, box_of(bricks, keys[n]), chunk, values,
                bricks.samples.data() + n * static_cast<std::size_t>(VoxelBricks::kSamples));
    }
  }
  return bricks;
}

}  // namespace footwall::ui
