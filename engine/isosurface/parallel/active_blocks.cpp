#include "engine/isosurface/parallel/active_blocks.h"

#include <algorithm>

namespace footwall::isosurface {
namespace {

constexpr std::int64_t kBrick = 8;
// Cutting a box costs the samples on both sides of the cut twice, and a read; below this it is not worth it.
constexpr std::int64_t kWorthCutting = 32 * 32 * 32;

survey::Box bricks_of(const survey::Box& cells) {
  survey::Box bricks;
  for (int axis = 0; axis < 3; ++axis) {
    bricks.lo[axis] = cells.lo[axis] / kBrick;
    bricks.hi[axis] = (cells.hi[axis] + kBrick - 1) / kBrick;
  }
  return bricks;
}

bool is_wanted(const Wanted& wanted, const survey::Index& brick) {
  const Bricks& bricks = *wanted.bricks;
  if (is_active(bricks, brick, wanted.isovalue)) return true;
  if (!wanted.caps) return false;
  bool border = false;
  for (int axis = 0; axis < 3; ++axis)
    border = border || brick[axis] == 0 || brick[axis] == bricks.dims[axis] - 1;
  return border && wanted.isovalue <= bricks.max[place_of(bricks, brick)];
}

// The smallest box around the wanted bricks of `cells`, and how many these are.
survey::Box tight(const survey::Box& cells, const Wanted& wanted, std::int64_t& active) {
  const survey::Box inside = bricks_of(cells);
  survey::Box around{inside.hi, inside.lo};
  active = 0;
  for (std::int64_t a = inside.lo[0]; a < inside.hi[0]; ++a) {
    for (std::int64_t b = inside.lo[1]; b < inside.hi[1]; ++b) {
      for (std::int64_t c = inside.lo[2]; c < inside.hi[2]; ++c) {
        const survey::Index brick{a, b, c};
        if (!is_wanted(wanted, brick)) continue;
        ++active;
        for (int axis = 0; axis < 3; ++axis) {
          around.lo[axis] = std::min(around.lo[axis], brick[axis]);
          around.hi[axis] = std::max(around.hi[axis], brick[axis] + 1);
        }
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    around.lo[axis] *= kBrick;
    around.hi[axis] *= kBrick;
  }
  return intersection(around, cells);
}

void add_blocks(const survey::Box& cells, const Wanted& wanted, std::vector<survey::Box>& blocks) {
  survey::Box box = cells;
  bool sparse = false;
  if (wanted.bricks != nullptr) {
    std::int64_t active = 0;
    box = tight(cells, wanted, active);
    if (active == 0) return;
    sparse = box.count() > kWorthCutting && active * 4 < bricks_of(box).count();
  }
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (box.size(axis) > box.size(longest)) longest = axis;
  }
  if ((!sparse && box.count() <= wanted.most_cells) || box.size(longest) <= kBrick) {
    blocks.push_back(box);
    return;
  }
  const std::int64_t middle = (box.lo[longest] + box.hi[longest]) / 2 / kBrick * kBrick;
  const std::int64_t cut = middle > box.lo[longest] ? middle : middle + kBrick;
  survey::Box first = box;
  survey::Box second = box;
  first.hi[longest] = cut;
  second.lo[longest] = cut;
  add_blocks(first, wanted, blocks);
  add_blocks(second, wanted, blocks);
}

}  // namespace

std::vector<survey::Box> active_blocks(const survey::Box& cells, const Wanted& wanted) {
  std::vector<survey::Box> blocks;
  if (!cells.empty()) add_blocks(cells, wanted, blocks);
  std::sort(blocks.begin(), blocks.end(),
            [](const survey::Box& a, const survey::Box& b) { return a.lo < b.lo; });
  return blocks;
}

}  // namespace footwall::isosurface
