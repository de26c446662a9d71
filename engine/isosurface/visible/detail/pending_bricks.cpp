#include "engine/isosurface/visible/detail/pending_bricks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <numeric>

#include "engine/isosurface/detail/threads.h"
#include "engine/isosurface/visible/active_parts.h"

namespace footwall::isosurface::detail {
namespace {

constexpr std::size_t kBricksAtOnce = 64;
// Walls are looked at after so many groups of bricks, of so many at the least,
constexpr std::size_t kMostGroups = 4;
constexpr std::size_t kLeastGroup = 256;
// where bricks lie so many deep on the screen. Elsewhere few are hidden as a whole, and looking costs more.
constexpr double kDeep = 10;

survey::Box cells_of_brick(const survey::Index& brick, const survey::Index& volume_size) {
  survey::Box cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[axis] = 8 * brick[axis];
    cells.hi[axis] = std::min(8 * brick[axis] + 8, volume_size[axis] - 1);
  }
  return cells;
}

double area_of(const render::ScreenBox& box) {
  return (box.x1 - box.x0 + 1.0) * (box.y1 - box.y0 + 1.0);
}

template <class Body>
void for_each_in_groups(std::size_t count, int threads, Body&& body) {
  const std::size_t groups = (count + kBricksAtOnce - 1) / kBricksAtOnce;
  for_each_in_parallel(static_cast<std::int64_t>(groups), threads, [&](std::int64_t group, int) {
    const std::size_t first = static_cast<std::size_t>(group) * kBricksAtOnce;
    for (std::size_t n = first; n < std::min(count, first + kBricksAtOnce); ++n) body(n);
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
  const bool has_cells = std::ranges::min(request.volume_size) > 1;
  for (std::size_t part = 0; part < parts.size() && has_cells; ++part) {
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
  restart();
}

void PendingBricks::restart() {
  for (PendingBrick& brick : bricks_) brick.boxed = brick.pending = brick.chosen = brick.drawn = 0;
  far_.clear();
  near_.clear();
  used_boxes_ = 0;
}

void PendingBricks::place(const ScreenBoxes& boxes, const VisibleRequest& request) {
  for_each_in_groups(bricks_.size(), request.threads, [&](std::size_t n) {
    PendingBrick& brick = bricks_[n];
    brick.loose = boxes.of(cells_of_brick(brick.at, request.volume_size));
  });
}

void PendingBricks::order(const PartSearch& search) {
  // Boxes' depths are less than kOpenPixel: each has a place to count at, and one is left for the sum.
  nearer_.assign(std::size_t{render::kOpenPixel} + 1, 0);
  double area = 0;
  for (PendingBrick& brick : bricks_) {
    if (brick.loose.empty()) continue;
    brick.box = search.boxes.scaled(brick.loose, search.scale);
    ++nearer_[brick.box.nearest];
    area += area_of(brick.box);
  }
  std::exclusive_scan(nearer_.begin(), nearer_.end(), nearer_.begin(), std::size_t{0});
  const std::size_t count = nearer_.back();
  groups_ = area > kDeep * area_of(search.rectangle) ? kMostGroups : 1;
  // Those of a group stay in the order of memory.
  const auto group_of = [&](const PendingBrick& brick) {
    return nearer_[brick.box.nearest] * groups_ / count;
  };
  std::array<std::size_t, kMostGroups + 1> places{};
  for (const PendingBrick& brick : bricks_) {
    if (!brick.loose.empty()) ++places[group_of(brick) + 1];
  }
  std::partial_sum(places.begin(), places.end(), places.begin());
  far_.resize(count);
  for (PendingBrick& brick : bricks_) {
    if (!brick.loose.empty()) far_[places[group_of(brick)]++] = &brick;
  }
}

void PendingBricks::find_parts(std::span<PendingBrick* const> some, const PartSearch& search) {
  const VisibleRequest& request = search.request;
  const auto field_of = [&](const PendingBrick& brick) -> const Field& {
    return search.parts[brick.part].field;
  };
  for_each_in_groups(some.size(), request.threads, [&](std::size_t n) {
    PendingBrick& brick = *some[n];
    if (brick.is_read) return;
    if (n + 1 < some.size()) fetch_brick(field_of(*some[n + 1]), some[n + 1]->at);
    brick.active = active_parts(field_of(brick), brick.at, request.isovalue);
    brick.is_read = true;
  });
  for (PendingBrick* const brick : some) {
    brick->first_box = used_boxes_;
    used_boxes_ += static_cast<std::size_t>(std::popcount(brick->active));
  }
  if (boxes_.size() < used_boxes_) boxes_.resize(used_boxes_);
  for_each_in_groups(some.size(), request.threads, [&](std::size_t n) {
    PendingBrick& brick = *some[n];
    brick.boxed = brick.pending =
        search.boxes.of_parts(cells_of_brick(brick.at, request.volume_size), brick.active, brick.box,
                              search.scale, boxes_.data() + brick.first_box);
  });
  near_.insert(near_.end(), some.begin(), some.end());
}

void PendingBricks::give_up_hidden(const render::DepthPyramid& depths, int threads) {
  give_up_hidden(near_, depths, threads);
  std::erase_if(far_, [&](const PendingBrick* brick) { return depths.hides(brick->box); });
}

void PendingBricks::find_some(const render::DepthPyramid& depths, const PartSearch& search,
                              std::int64_t enough) {
  std::int64_t pending = pending_parts();
  std::size_t first = 0;
  while (first < far_.size() && pending <= enough) {
    const std::size_t count = std::min(kLeastGroup, far_.size() - first);
    const std::span<PendingBrick* const> some = std::span(far_).subspan(first, count);
    find_parts(some, search);
    give_up_hidden(some, depths, search.request.threads);
    for (const PendingBrick* const brick : some) pending += std::popcount(brick->pending);
    first += count;
  }
  far_.erase(far_.begin(), far_.begin() + static_cast<std::ptrdiff_t>(first));
}

void PendingBricks::give_up_hidden(std::span<PendingBrick* const> some, const render::DepthPyramid& depths,
                                   int threads) {
  for_each_in_groups(some.size(), threads, [&](std::size_t n) {
    PendingBrick& brick = *some[n];
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

// From the nearest on, so many at a time: visits the far bricks that are not hidden as it is then, and finds
// their parts.
template <class Hides, class Visit>
void PendingBricks::visit_far(std::size_t group, const PartSearch& search, Hides&& hides, Visit&& visit) {
  std::size_t still_far = 0;
  for (std::size_t first = 0; first < far_.size(); first += group) {
    const std::size_t end = std::min(first + group, far_.size());
    found_.clear();
    for (std::size_t n = first; n < end; ++n) {
      if (hides(far_[n]->box)) {
        far_[still_far++] = far_[n];
      } else {
        found_.push_back(far_[n]);
      }
    }
    find_parts(found_, search);
    visit(end < far_.size());
  }
  far_.resize(still_far);
}

void PendingBricks::cover(render::DepthPyramid& depths, const render::DepthPyramid* earlier,
                          const PartSearch& search) {
  cover(near_, depths);
  if (far_.empty()) return;
  if (groups_ > 1) depths.build();
  // A far brick behind the walls that stand already cannot change them: its own are behind it.
  visit_far(
      std::max(kLeastGroup, (bricks_.size() + groups_ - 1) / groups_), search,
      [&](const render::ScreenBox& box) { return groups_ > 1 && depths.hides(box); },
      [&](bool goes_on) {
        if (earlier != nullptr) give_up_hidden(found_, *earlier, search.request.threads);
        cover(found_, depths);
        if (goes_on) depths.build();
      });
}

void PendingBricks::cover(std::span<PendingBrick* const> some, render::DepthPyramid& depths) const {
  const render::ScreenBox& window = depths.window();
  for (const PendingBrick* const brick : some) {
    for_each_box(*brick, boxes_, brick->pending, [&](BrickParts, const render::ScreenBox& box) {
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
  for_each_in_groups(near_.size(), threads, [&](std::size_t n) {
    PendingBrick& brick = *near_[n];
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

void PendingBricks::choose(std::span<const BrickParts> seen, const PartSearch& search) {
  const auto is_seen = [&](const PendingBrick* brick) { return seen[brick->word] != 0; };
  found_.clear();
  std::ranges::copy_if(far_, std::back_inserter(found_), is_seen);
  std::erase_if(far_, is_seen);
  find_parts(found_, search);
  for (PendingBrick* const brick : near_) brick->chosen = brick->pending & seen[brick->word];
}

void PendingBricks::weigh_chosen(std::span<const VolumePart> parts, const ExpectedTriangles* expected,
                                 int threads) {
  // Of a part: it has about four cells with two triangles each.
  constexpr std::int64_t kMost = 8 * ExpectedTriangles::kTriangle;
  for_each_in_groups(bricks_.size(), threads, [&](std::size_t n) {
    PendingBrick& brick = bricks_[n];
    if (expected == nullptr || brick.chosen == 0) {
      brick.work = kMost * std::popcount(brick.chosen);
    } else {
      brick.work = expected->of(parts[brick.part].field, brick.at, brick.chosen);
    }
  });
}

void PendingBricks::finish_chosen() {
  for (PendingBrick* const brick : near_) {
    brick->pending &= ~brick->chosen;
    brick->drawn |= brick->chosen;
    brick->chosen = 0;
  }
}

void PendingBricks::take_up_drawn() {
  for (PendingBrick* const brick : near_) brick->pending = brick->drawn;
  far_.clear();
}

void PendingBricks::close(render::DepthPyramid& open, const render::DepthPyramid& depths,
                          const PartSearch& search) {
  close(near_, open, depths);
  if (far_.empty()) return;
  open.build();
  visit_far(
      far_.size(), search, [&](const render::ScreenBox& box) { return open.is_closed(box); },
      [&](bool) {
        give_up_hidden(found_, depths, search.request.threads);
        close(found_, open, depths);
      });
}

void PendingBricks::close(std::span<PendingBrick* const> some, render::DepthPyramid& open,
                          const render::DepthPyramid& depths) const {
  for (const PendingBrick* const brick : some) {
    if (brick->pending == 0 || depths.is_closed(brick->box)) continue;
    for_each_box(*brick, boxes_, brick->pending,
                 [&](BrickParts, const render::ScreenBox& box) { open.cover(box, 0); });
  }
}

std::int64_t PendingBricks::pending_parts() const {
  std::int64_t count = 0;
  for (const PendingBrick* const brick : near_) count += std::popcount(brick->pending);
  return count;
}

std::int64_t PendingBricks::chosen_parts() const {
  std::int64_t count = 0;
  for (const PendingBrick* const brick : near_) count += std::popcount(brick->chosen);
  return count;
}

std::int64_t PendingBricks::chosen_bricks() const {
  return std::ranges::count_if(near_, [](const PendingBrick* brick) { return brick->chosen != 0; });
}

}  // namespace footwall::isosurface::detail
