#include "engine/isosurface/parallel/pillars.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::isosurface {
namespace {

constexpr std::int64_t kMost = 1024;

// Cells of the busiest place of `ranks` along an axis whose `cells` are cut into ranks * interleaving pieces.
std::int64_t busiest(std::int64_t cells, int ranks, int interleaving) {
  const std::int64_t parts = std::int64_t{ranks} * interleaving;
  std::int64_t most = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    std::int64_t sum = 0;
    for (std::int64_t part = rank; part < parts; part += ranks)
      sum += cells * (part + 1) / parts - cells * part / parts;
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace

Interleaving parse_interleaving(std::string_view text) {
  const std::vector<std::string_view> words = text::split(text, 'x');
  Interleaving interleaving{1, 1, 1};
  bool good = words.size() == 2 || words.size() == 3;
  for (std::size_t n = 0; good && n < words.size(); ++n) {
    const std::optional<std::int64_t> number = text::integer(words[n]);
    good = number && *number >= 1 && *number <= kMost;
    if (good) interleaving[n] = static_cast<int>(*number);
  }
  if (!good) {
    throw Error(ErrorCode::kUsage, fmt::format("'{}' is not a number of pillars", text),
                fmt::format("give those of a rank along inlines x along crosslines, as 4x2, and pieces along "
                            "samples, as 4x2x2; each 1 to {}",
                            kMost));
  }
  return interleaving;
}

std::string text_of(const Interleaving& interleaving) {
  return fmt::format("{}x{}x{}", interleaving[0], interleaving[1], interleaving[2]);
}

Pillars::Pillars(const survey::Index& volume, int ranks, const Interleaving& interleaving)
    : volume_(volume), interleaving_(interleaving) {
  require(ranks >= 1, "there is at least one rank");
  for (int axis = 0; axis < 3; ++axis) {
    require(volume[axis] >= 1, "a volume has samples");
    require(interleaving[axis] >= 1, "every rank has a pillar");
    cells_[axis] = volume[axis] - 1;
  }
  auto best = std::tuple{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::max()};
  for (int a = 1; a <= ranks; ++a) {
    if (ranks % a != 0) continue;
    const int b = ranks / a;
    const std::int64_t load = busiest(cells_[0], a, interleaving[0]) * busiest(cells_[1], b, interleaving[1]);
    const std::int64_t border =
        std::int64_t{a} * interleaving[0] * cells_[1] + std::int64_t{b} * interleaving[1] * cells_[0];
    if (std::tuple{load, border} >= best) continue;
    best = {load, border};
    grid_ = {a, b};
  }
  parts_ = {grid_[0] * interleaving[0], grid_[1] * interleaving[1], interleaving[2]};
}

int Pillars::rank_of(const std::array<int, 3>& part) const {
  const int below = part[0] % grid_[0] * grid_[1] + part[1] % grid_[1];
  return (below + part[2]) % ranks();
}

int Pillars::part_of(int axis, std::int64_t cell) const {
  // The last part that begins at or before the cell: of parts that begin at one cell all but the last are
  // empty.
  return static_cast<int>(((cell + 1) * parts_[axis] - 1) / cells_[axis]);
}

std::vector<Pillar> Pillars::all() const {
  std::vector<Pillar> pillars;
  for (int a = 0; a < parts_[0]; ++a) {
    for (int b = 0; b < parts_[1]; ++b) {
      for (int c = 0; c < parts_[2]; ++c) {
        const survey::Box cells{{first_of(0, a), first_of(1, b), first_of(2, c)},
                                {first_of(0, a + 1), first_of(1, b + 1), first_of(2, c + 1)}};
        if (!cells.empty()) pillars.push_back({rank_of({a, b, c}), cells});
      }
    }
  }
  return pillars;
}

std::vector<survey::Box> Pillars::of_rank(int rank) const {
  std::vector<survey::Box> mine;
  for (const Pillar& pillar : all()) {
    if (pillar.rank == rank) mine.push_back(pillar.cells);
  }
  return mine;
}

int Pillars::owner(const survey::Index& cell) const {
  return rank_of({part_of(0, cell[0]), part_of(1, cell[1]), part_of(2, cell[2])});
}

survey::Index Pillars::cell_of(const survey::Index& sample) const {
  survey::Index cell;
  for (int axis = 0; axis < 3; ++axis) cell[axis] = std::min(sample[axis], cells_[axis] - 1);
  return cell;
}

survey::Box Pillars::samples_of(const survey::Box& cells, bool normals) const {
  const std::int64_t more = normals ? 1 : 0;
  survey::Box samples;
  for (int axis = 0; axis < 3; ++axis) {
    samples.lo[axis] = std::max<std::int64_t>(0, cells.lo[axis] - more);
    samples.hi[axis] = std::min(volume_[axis], cells.hi[axis] + 1 + more);
  }
  return samples;
}

std::int64_t Pillars::overlap_samples(bool normals) const {
  std::int64_t stored = 0;
  for (const Pillar& pillar : all()) stored += samples_of(pillar.cells, normals).count();
  // A volume without cells is not stored at all.
  return stored == 0 ? 0 : stored - volume_[0] * volume_[1] * volume_[2];
}

}  // namespace footwall::isosurface
