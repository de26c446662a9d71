#include "engine/isosurface/visible/paper/extract_cells.h"

#include <algorithm>
#include <limits>

#include "engine/isosurface/visible/octree.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr std::int64_t kBrick = kBrickCells[0];

// The rows (i, j) of a surface, with their triangles.
template <class Visit>
void for_each_row(const Surface& surface, Visit&& visit) {
  std::size_t row = 0;
  for (std::int64_t i = surface.cells.lo[0]; i < surface.cells.hi[0]; ++i) {
    for (std::int64_t j = surface.cells.lo[1]; j < surface.cells.hi[1]; ++j, ++row) {
      const auto first = static_cast<std::size_t>(surface.row_first[row]);
      const auto last = static_cast<std::size_t>(surface.row_first[row + 1]);
      if (first < last) visit(i, j, first, last);
    }
  }
}

// Triangles that belong together, and where they are now.
struct Stretch {
  render::PrimitiveId id;
  std::size_t first;
  std::size_t count;
};

// Behind what is there.
void append(const Surface& part, Surface& into) {
  const std::size_t vertices = into.positions.size();
  const std::size_t triangles = into.triangles.size();
  if (vertices + part.positions.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::kUnsupported, "the isosurface would have more than 2^32 - 1 vertices",
                "take a part of the volume, or more ranks");
  }
  into.positions.grow(vertices + part.positions.size());
  into.normals.grow(vertices + part.normals.size());
  into.triangles.grow(triangles + part.triangles.size());
  std::copy(part.positions.all().begin(), part.positions.all().end(), into.positions.data() + vertices);
  std::copy(part.normals.all().begin(), part.normals.all().end(), into.normals.data() + vertices);
  const auto by = static_cast<std::uint32_t>(vertices);
  Triangle* to = into.triangles.data() + triangles;
  for (const Triangle& of : part.triangles.all()) *to++ = {of[0] + by, of[1] + by, of[2] + by};
}

}  // namespace

render::LitSurface lit(const SomeTriangles& some, render::Rgba colour, const render::Placement& placement) {
  static_assert(sizeof(Point) == sizeof(render::Vec3f) &&
                sizeof(Triangle) == sizeof(render::TriangleIndices));
  // Three floats and three indices each, under two names: the renderer does not know isosurfaces.
  const auto vectors = [](std::span<const Point> points) {
    return std::span(reinterpret_cast<const render::Vec3f*>(points.data()), points.size());
  };
  const std::span<const Triangle> triangles = some.surface.triangles.all();
  return {colour,
          placement,
          vectors(some.surface.positions.all()),
          vectors(some.surface.normals.all()),
          {reinterpret_cast<const render::TriangleIndices*>(triangles.data()), triangles.size()},
          some.runs};
}

ExtractCells::ExtractCells(const Field& volume, const Bricks& bricks, float isovalue, int threads)
    : volume_(volume), all_(bricks), isovalue_(isovalue), threads_(threads), order_(bricks, isovalue) {
  const auto count = static_cast<std::size_t>(bricks.dims[0] * bricks.dims[1] * bricks.dims[2]);
  for (int axis = 0; axis < 3; ++axis) {
    if (volume.size[axis] != volume.volume_size[axis] ||
        bricks.dims[axis] != std::max<std::int64_t>(1, (volume.size[axis] - 1 + kBrick - 1) / kBrick)) {
      throw Error(ErrorCode::kInvalid, "cells are extracted from a whole volume with its table of bricks");
    }
  }
  some_.dims = bricks.dims;
  some_.min.assign(count, kInf);
  some_.max.assign(count, -kInf);
  some_.has_null.assign(bricks.has_null.begin(), bricks.has_null.end());
}

bool ExtractCells::are_bricks(const survey::Box& box) const {
  for (int axis = 0; axis < 3; ++axis) {
    const bool at_end = box.hi[axis] == volume_.size[axis] - 1;
    if (box.lo[axis] % kBrick != 0 || (box.hi[axis] % kBrick != 0 && !at_end)) return false;
  }
  return true;
}

void ExtractCells::set_bricks(const survey::Box& box, bool there) {
  const auto end = [&](int axis) { return (box.hi[axis] + kBrick - 1) / kBrick; };
  for (std::int64_t a = box.lo[0] / kBrick; a < end(0); ++a) {
    for (std::int64_t b = box.lo[1] / kBrick; b < end(1); ++b) {
      for (std::int64_t c = box.lo[2] / kBrick; c < end(2); ++c) {
        const auto n = static_cast<std::size_t>((a * all_.dims[1] + b) * all_.dims[2] + c);
        some_.min[n] = there ? all_.min[n] : kInf;
        some_.max[n] = there ? all_.max[n] : -kInf;
      }
    }
  }
}

bool ExtractCells::is_set(std::int64_t i, std::int64_t j, std::int64_t c) const {
  const auto n = static_cast<std::size_t>((i / kBrick * all_.dims[1] + j / kBrick) * all_.dims[2] + c);
  return c < all_.dims[2] && some_.min[n] < isovalue_ && isovalue_ <= some_.max[n];
}

void ExtractCells::find_runs(SomeTriangles& some) const {
  const Surface& surface = some.surface;
  some.runs.clear();
  for_each_row(surface, [&](std::int64_t i, std::int64_t j, std::size_t first, std::size_t last) {
    std::int64_t brick = -1;
    for (std::size_t t = first; t < last; ++t) {
      const Triangle& corners = surface.triangles.data()[t];
      const auto k = [&](std::size_t n) { return surface.positions.data()[corners[n]].k; };
      const auto cell = static_cast<std::int64_t>(std::min({k(0), k(1), k(2)}));
      // One that lies in the border between two bricks may be the lower one's: it, and what follows in its
      // cell, is then counted as the upper one's, if that is there; the order is kept.
      std::int64_t of = cell / kBrick;
      if (!is_set(i, j, of)) --of;
      if (of <= brick) continue;
      brick = of;
      some.runs.push_back({t, order_.first(i, j, brick * kBrick)});
    }
  });
}

void ExtractCells::extract_bricks(std::span<const survey::Box> boxes, SomeTriangles& into) {
  ExtractOptions options;
  options.threads = threads_;
  survey::Box around = boxes.front();
  for (const survey::Box& box : boxes) {
    set_bricks(box, true);
    for (int axis = 0; axis < 3; ++axis) {
      around.lo[axis] = std::min(around.lo[axis], box.lo[axis]);
      around.hi[axis] = std::max(around.hi[axis], box.hi[axis]);
    }
  }
  const Bricks tables = some_.tables();
  options.cells = around;
  options.bricks = &tables;
  isosurface::extract(volume_, isovalue_, options, into.surface);
  find_runs(into);
  for (const survey::Box& box : boxes) set_bricks(box, false);
}

void ExtractCells::extract_boxes(std::span<const survey::Box> boxes, SomeTriangles& into) {
  Surface all;
  Surface part;
  std::vector<Stretch> stretches;
  for (const survey::Box& box : boxes) {
    ExtractOptions options;
    options.cells = box;
    isosurface::extract(volume_, isovalue_, options, part);
    const std::size_t before = all.triangles.size();
    for_each_row(part, [&](std::int64_t i, std::int64_t j, std::size_t first, std::size_t last) {
      stretches.push_back({order_.first(i, j, box.lo[2]), before + first, last - first});
    });
    append(part, all);
  }
  std::sort(stretches.begin(), stretches.end(),
            [](const Stretch& a, const Stretch& b) { return a.id < b.id; });
  into.surface.triangles.resize_uninitialised(all.triangles.size());
  into.runs.clear();
  std::size_t next = 0;
  for (const Stretch& stretch : stretches) {
    into.runs.push_back({next, stretch.id});
    const Triangle* const from = all.triangles.data() + stretch.first;
    std::copy(from, from + stretch.count, into.surface.triangles.data() + next);
    next += stretch.count;
  }
  into.surface.positions = std::move(all.positions);
  into.surface.normals = std::move(all.normals);
}

void ExtractCells::extract(std::span<const survey::Box> boxes, SomeTriangles& into) {
  std::vector<survey::Box> with_cells;
  for (const survey::Box& box : boxes) {
    if (!box.empty()) with_cells.push_back(box);
  }
  if (with_cells.empty()) {
    into = {};
    return;
  }
  const bool bricks = std::all_of(with_cells.begin(), with_cells.end(),
                                  [&](const survey::Box& box) { return are_bricks(box); });
  if (bricks) {
    extract_bricks(with_cells, into);
  } else {
    extract_boxes(with_cells, into);
  }
  into.surface.row_first.clear();
  into.surface.cells = {};
}

}  // namespace footwall::isosurface
