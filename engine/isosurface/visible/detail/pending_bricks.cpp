#include "engine/isosurface/visible/detail/pending_bricks.h"

#include <algorithm>
#include <bit>

#include "engine/isosurface/detail/threads.h"
#include "engine/isosurface/visible/active_parts.h"

namespace footwall::isosurface::detail {
namespace {

constexpr std::int64_t kBricksAtOnce = 64;

survey::Box cells_of_brick(const survey::Index& brick, const survey::Index& volume_size) {
  survey::Box cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[axis] = 8 * brick[axis];
    cells.hi[axis] = std::min(8 * brick[axis] + 8, volume_size[axis] - 1);
  }
  return cells;
}

template <class Body>
void for_each_brick(std::span<PendingBrick> bricks, int threads, Body&& body) {
  const auto count = static_cast<std::int64_t>(bricks.size());
  for_each_in_parallel((count + kBricksAtOnce - 1) / kBricksAtOnce, threads, [&](std::int64_t group, int) {
    for (std::int64_t n = group * kBricksAtOnce; n < std::min(count, (group + 1) * kBricksAtOnce); ++n)
      body(bricks[static_cast<std::size_t>(n)]);
  });
}

// Calls visit(bit, box) for the parts of `some`, all of which have boxes.
template <class Visit>
void for_each_box(const PendingBrick& brick, const std::vector<render::ScreenBox>& boxes, BrickParts some,
                  Visit&& visit) {
  for (BrickParts left = some; left != 0; left &= left - 1) {
    const BrickParts bit = left & (~left + 1);
    visit(bit, boxes[brick.first_box + static_cast<std::size_t>(std::popcount(brick.boxed & (bit - 1)))]);
  }
}

}  // namespace

void PendingBricks::collect(std::span<const VolumePart> parts, const VisibleRequest& request) {
  bricks_.clear();
  const Bricks& table = request.bricks;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const survey::Box& box = parts[part].bricks;
    for (std::int64_t a = box.lo[0]; a < box.hi[0]; ++a) {
      for (std::int64_t b = box.lo[1]; b < box.hi[1]; ++b) {
        const auto row = static_cast<std::size_t>((a * table.dims[1] + b) * table.dims[2]);
        for (std::int64_t c = box.lo[2]; c < box.hi[2]; ++c) {
          const std::size_t word = row + static_cast<std::size_t>(c);
          if (!(table.min[word] < request.isovalue && request.isovalue <= table.max[word])) continue;
          PendingBrick& brick = bricks_.emplace_back();
          brick.at = {a, b, c};
          brick.word = word;
          brick.part = part;
        }
      }
    }
  }
  for_each_brick(bricks_, request.threads, [&](PendingBrick& brick) {
    const PendingBrick* const next = &brick + 1;
    if (next < bricks_.data() + bricks_.size()) fetch_brick(parts[next->part].field, next->at);
    brick.active = active_parts(parts[brick.part].field, brick.at, request.isovalue);
  });
  std::erase_if(bricks_, [](const PendingBrick& brick) { return brick.active == 0; });
  restart();
}

void PendingBricks::restart() {
  std::size_t boxes = 0;
  for (PendingBrick& brick : bricks_) {
    brick.boxed = brick.pending = brick.chosen = brick.drawn = 0;
    brick.first_box = boxes;
    boxes += static_cast<std::size_t>(std::popcount(brick.active));
  }
  boxes_.resize(boxes);
}

void PendingBricks::place(const ScreenBoxes& boxes, const VisibleRequest& request) {
  for_each_brick(bricks_, request.threads, [&](PendingBrick& brick) {
    brick.loose = boxes.of(cells_of_brick(brick.at, request.volume_size));
  });
}

void PendingBricks::place_parts(const ScreenBoxes& boxes, const render::DepthScale& scale,
                                const VisibleRequest& request) {
  for_each_brick(bricks_, request.threads, [&](PendingBrick& brick) {
    if (brick.loose.empty()) return;
    brick.box = boxes.scaled(brick.loose, scale);
    brick.boxed = brick.pending = boxes.of_parts(cells_of_brick(brick.at, request.volume_size), brick.active,
                                                 scale, boxes_.data() + brick.first_box);
  });
}

void PendingBricks::give_up_hidden(const render::DepthPyramid& depths, int threads) {
  for_each_brick(bricks_, threads, [&](PendingBrick& brick) {
    if (brick.pending == 0) return;
    if (depths.hides(brick.box)) {
      brick.pending = 0;
      return;
    }
    BrickParts hidden = 0;
    for_each_box(brick, boxes_, brick.pending, [&](BrickParts bit, const render::ScreenBox& box) {
      if (depths.hides(box)) hidden |= bit;
    });
    brick.pending &= ~hidden;
  });
}

void PendingBricks::cover(render::DepthPyramid& depths) const {
  const render::ScreenBox& window = depths.window();
  for (const PendingBrick& brick : bricks_) {
    for_each_box(brick, boxes_, brick.pending, [&](BrickParts, const render::ScreenBox& box) {
      // What may be anywhere is no wall.
      if (box.nearest == 0 && box.x0 <= window.x0 && box.x1 >= window.x1) return;
      // The corners of a box are hardly ever covered.
      render::ScreenBox wall = box;
      if (box.x1 - box.x0 >= 2) {
        ++wall.x0;
        --wall.x1;
      }
      if (box.y1 - box.y0 >= 2) {
        ++wall.y0;
        --wall.y1;
      }
      depths.cover(wall, box.farthest);
    });
  }
}

void PendingBricks::choose(const render::DepthPyramid* depths, int threads) {
  for_each_brick(bricks_, threads, [&](PendingBrick& brick) {
    brick.chosen = brick.pending;
    if (depths == nullptr || brick.pending == 0) return;
    if (depths->hides(brick.box)) {
      brick.chosen = 0;
      return;
    }
    for_each_box(brick, boxes_, brick.pending, [&](BrickParts bit, const render::ScreenBox& box) {
      if (depths->hides(box)) brick.chosen &= ~bit;
    });
  });
}

void PendingBricks::choose(std::span<const BrickParts> seen) {
  for (PendingBrick& brick : bricks_) brick.chosen = brick.pending & seen[brick.word];
}

void PendingBricks::weigh_chosen(std::span<const VolumePart> parts, const ExpectedTriangles* expected,
                                 int threads) {
  // Of a part: it has about four cells with two triangles each.
  constexpr std::int64_t kMost = 8 * ExpectedTriangles::kTriangle;
  for_each_brick(bricks_, threads, [&](PendingBrick& brick) {
    if (expected == nullptr || brick.chosen == 0) {
      brick.work = kMost * std::popcount(brick.chosen);
    } else {
      brick.work = expected->of(parts[brick.part].field, brick.at, brick.chosen);
    }
  });
}

void PendingBricks::finish_chosen() {
  for (PendingBrick& brick : bricks_) {
    brick.pending &= ~brick.chosen;
    brick.drawn |= brick.chosen;
    brick.chosen = 0;
  }
}

void PendingBricks::take_up_drawn() {
  for (PendingBrick& brick : bricks_) brick.pending = brick.drawn;
}

void PendingBricks::mark_open(const render::DepthPyramid& depths, std::span<std::uint64_t> bits) const {
  for (const PendingBrick& brick : bricks_) {
    for_each_box(brick, boxes_, brick.pending,
                 [&](BrickParts, const render::ScreenBox& box) { depths.mark_open(box, bits); });
  }
}

std::int64_t PendingBricks::pending_parts() const {
  std::int64_t count = 0;
  for (const PendingBrick& brick : bricks_) count += std::popcount(brick.pending);
  return count;
}

std::int64_t PendingBricks::chosen_parts() const {
  std::int64_t count = 0;
  for (const PendingBrick& brick : bricks_) count += std::popcount(brick.chosen);
  return count;
}

std::int64_t PendingBricks::chosen_bricks() const {
  return std::count_if(bricks_.begin(), bricks_.end(),
                       [](const PendingBrick& brick) { return brick.chosen != 0; });
}

}  // namespace footwall::isosurface::detail
