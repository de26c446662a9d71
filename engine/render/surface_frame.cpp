#include "engine/render/surface_frame.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr std::size_t kVerticesAtOnce = 1 << 14;
constexpr std::size_t kTrianglesAtOnce = 1 << 14;
constexpr int kRowsAtOnce = 16;

// Weights of the corners at a pixel's centre, all of one sign where it is inside; exact.
std::array<std::int64_t, 3> weights_at(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                                       int x, int y) {
  const std::int64_t px = std::int64_t{x} * kSubPixels + kSubPixels / 2;
  const std::int64_t py = std::int64_t{y} * kSubPixels + kSubPixels / 2;
  const auto edge = [&](const ScreenVertex& p, const ScreenVertex& q) {
    return (std::int64_t{q.x} - p.x) * (py - p.y) - (std::int64_t{q.y} - p.y) * (px - p.x);
  };
  return {edge(b, c), edge(c, a), edge(a, b)};
}

// The same in clip space, for triangles that reach behind the eye or far beside the picture.
std::array<double, 3> weights_at(const Vec4& a, const Vec4& b, const Vec4& c, double x, double y) {
  const auto edge = [&](const Vec4& p, const Vec4& q) {
    return x * (p.y * q.w - q.y * p.w) - y * (p.x * q.w - q.x * p.w) + (p.x * q.y - q.x * p.y);
  };
  return {edge(b, c), edge(c, a), edge(a, b)};
}

// Each of the stretches ends where it says, and ascends; neighbours are merged until there is one.
void merge_stretches(std::vector<PrimitiveTable::Entry>& entries, std::vector<std::size_t> ends) {
  const auto at = [&](std::size_t n) { return entries.begin() + static_cast<std::ptrdiff_t>(n); };
  while (ends.size() > 1) {
    std::vector<std::size_t> fewer;
    std::size_t begin = 0;
    for (std::size_t n = 0; n < ends.size(); n += 2) {
      const std::size_t last = std::min(n + 1, ends.size() - 1);
      if (last > n) {
        std::inplace_merge(at(begin), at(ends[n]), at(ends[last]),
                           [](const PrimitiveTable::Entry& a, const PrimitiveTable::Entry& b) {
                             return a.first_id < b.first_id;
                           });
      }
      begin = ends[last];
      fewer.push_back(begin);
    }
    ends = std::move(fewer);
  }
}

}  // namespace

void PrimitiveTable::assign(std::span<const LitSurface> surfaces) {
  entries_.clear();
  buckets_.assign(1, 0);
  lowest_ = 0;
  shift_ = 31;
  std::size_t triangles = 0;
  PrimitiveId highest = 0;
  std::vector<std::size_t> sorted;  // where stretches of ascending numbers end
  for (std::uint32_t n = 0; n < surfaces.size(); ++n) {
    const LitSurface& surface = surfaces[n];
    if (surface.triangles.empty()) continue;
    triangles += surface.triangles.size();
    for (const IdRun& run : surface.runs) {
      if (!entries_.empty() && entries_.back().first_id > run.first_id) sorted.push_back(entries_.size());
      entries_.push_back({run.first_id, n, run.first_triangle});
    }
    const IdRun& last = surface.runs.back();
    highest = std::max(highest, last.first_id + static_cast<PrimitiveId>(surface.triangles.size() - 1 -
                                                                         last.first_triangle));
  }
  if (entries_.empty()) return;
  sorted.push_back(entries_.size());
  merge_stretches(entries_, std::move(sorted));
  lowest_ = entries_.front().first_id;
  // About as many buckets as runs, so that few steps lead from a bucket to the run.
  const std::uint64_t numbers = std::uint64_t{highest} - lowest_ + 1;
  shift_ = 0;
  while (shift_ < 31 && numbers >> shift_ > 2 * entries_.size()) ++shift_;
  buckets_.assign(static_cast<std::size_t>((numbers - 1) >> shift_) + 1, 0);
  std::size_t entry = 0;
  for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
    const std::uint64_t first = lowest_ + (std::uint64_t{bucket} << shift_);
    while (entry + 1 < entries_.size() && entries_[entry + 1].first_id <= first) ++entry;
    buckets_[bucket] = static_cast<std::uint32_t>(entry);
  }
}

void SurfaceFrame::project(std::span<const LitSurface> surfaces, const Camera& camera, int width, int height,
                           int threads) {
  begin(camera, width, height);
  for (const LitSurface& surface : surfaces) add(surface, threads);
  number();
}

void SurfaceFrame::begin(const Camera& camera, int width, int height) {
  surfaces_.clear();
  camera_ = camera;
  width_ = width;
  height_ = height;
}

std::size_t SurfaceFrame::add(const LitSurface& surface, int threads) {
  const std::size_t n = surfaces_.size();
  surfaces_.push_back(surface);
  if (projected_.size() < surfaces_.size()) projected_.resize(surfaces_.size());
  const std::span<const Vec3f> positions = surface.positions;
  Projected& to = projected_[n];
  if (to.room < positions.size()) {
    to.vertices.reset();
    to.vertices = std::make_unique_for_overwrite<ScreenVertex[]>(positions.size());
    to.room = positions.size();
  }
  to.to_clip = surface.placement.then(camera_.view_projection);
  to.to_view = normals_to_view(surface.placement, camera_);
  to.mirrors = surface.placement.mirrors();
  const std::span<ScreenVertex> vertices(to.vertices.get(), positions.size());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (std::size_t first = 0; first < positions.size(); first += kVerticesAtOnce) {
    const std::size_t count = std::min(kVerticesAtOnce, positions.size() - first);
    render::project(to.to_clip, positions.subspan(first, count), width_, height_,
                    vertices.subspan(first, count));
  }
  return n;
}

void SurfaceFrame::keep(std::size_t surface, std::span<const TriangleIndices> triangles,
                        std::span<const IdRun> runs) {
  surfaces_[surface].triangles = triangles;
  surfaces_[surface].runs = runs;
}

std::size_t SurfaceFrame::triangles() const {
  std::size_t all = 0;
  for (const LitSurface& surface : surfaces_) all += surface.triangles.size();
  return all;
}

void SurfaceFrame::rasterize(VisibilityBuffer& window, int threads, std::size_t first) const {
  struct Part {
    std::size_t surface;
    TriangleRange range;
  };
  std::vector<Part> parts;
  for (std::size_t n = first; n < surfaces_.size(); ++n) {
    const std::size_t count = surfaces_[n].triangles.size();
    for (std::size_t begin = 0; begin < count; begin += kTrianglesAtOnce)
      parts.push_back({n, {begin, std::min(begin + kTrianglesAtOnce, count)}});
  }
  const auto draw = [&](const Part& part, VisibilityBuffer& into) {
    const LitSurface& surface = surfaces_[part.surface];
    render::rasterize(projected_[part.surface].to_clip, surface.positions, vertices_of(part.surface),
                      surface.triangles, surface.runs, part.range, into);
  };
  const int workers =
      static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads), parts.size()));
  if (workers <= 1) {
    for (const Part& part : parts) draw(part, window);
    return;
  }
  std::vector<VisibilityBuffer> own;
  for (int n = 1; n < workers; ++n)
    own.emplace_back(window.width(), window.height(), window.first_row(), window.rows());
#pragma omp parallel num_threads(workers)
  {
    const int worker = omp_get_thread_num();
    VisibilityBuffer& into = worker == 0 ? window : own[static_cast<std::size_t>(worker - 1)];
#pragma omp for schedule(dynamic, 4)
    for (std::size_t n = 0; n < parts.size(); ++n) draw(parts[n], into);
#pragma omp for schedule(static)
    for (int y = window.first_row(); y < window.first_row() + window.rows(); ++y) {
      const std::span<Visible> to = window.row(y);
      for (VisibilityBuffer& other : own) {
        const std::span<const Visible> from = other.row(y);
        for (std::size_t x = 0; x < to.size(); ++x) to[x] = std::min(to[x], from[x]);
      }
    }
  }
}

void SurfaceFrame::shade(const VisibilityBuffer& window, std::span<Rgba> colours, int threads) {
  require(colours.size() == window.pixels().size(), "one colour per pixel");
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (int begin = 0; begin < window.rows(); begin += kRowsAtOnce)
    shade_rows(window, begin, std::min(begin + kRowsAtOnce, window.rows()), colours);
}

void SurfaceFrame::shade_rows(const VisibilityBuffer& window, int begin, int end,
                              std::span<Rgba> colours) const {
  struct Seen {
    std::uint32_t surface;
    std::int32_t x;
    std::size_t triangle;
  };
  // So many pixels ahead of the one that is worked on, its triangle is fetched; half as many, its vertices.
  constexpr std::size_t kAhead = 24;
  std::vector<Seen> seen;
  LitPixels pixels;
  std::array<Rgba, LitPixels::kRoom> lit{};
  for (int row = begin; row < end; ++row) {
    const int y = window.first_row() + row;
    const std::span<const Visible> visibles = window.row(y);
    const std::span<Rgba> to =
        colours.subspan(static_cast<std::size_t>(row) * visibles.size(), visibles.size());
    seen.clear();
    for (std::size_t x = 0; x < visibles.size(); ++x) {
      const PrimitiveId id = primitive_of(visibles[x]);
      to[x] = 0;
      if (id == kNoPrimitive) continue;
      if (x + kAhead < visibles.size()) table_.fetch(primitive_of(visibles[x + kAhead]));
      const PrimitiveTable::Entry& entry = table_.entry_of(id);
      seen.push_back(
          {entry.surface, static_cast<std::int32_t>(x), entry.first_triangle + (id - entry.first_id)});
    }
    std::size_t first = 0;  // of the pixels that wait for light
    const auto flush = [&](std::size_t next) {
      const std::uint32_t surface = seen[first].surface;
      light_pixels(projected_[surface].to_view, surfaces_[surface].colour, pixels, lit);
      for (std::size_t n = first; n < next; ++n) to[static_cast<std::size_t>(seen[n].x)] = lit[n - first];
      pixels.count = 0;
      first = next;
    };
    for (std::size_t n = 0; n < seen.size(); ++n) {
      if (n + kAhead < seen.size()) {
        const Seen& later = seen[n + kAhead];
        __builtin_prefetch(&surfaces_[later.surface].triangles[later.triangle]);
      }
      if (n + kAhead / 2 < seen.size()) {
        const Seen& soon = seen[n + kAhead / 2];
        const LitSurface& surface = surfaces_[soon.surface];
        for (const std::int32_t v : surface.triangles[soon.triangle]) {
          __builtin_prefetch(&surface.normals[static_cast<std::size_t>(v)]);
          __builtin_prefetch(&projected_[soon.surface].vertices[static_cast<std::size_t>(v)]);
        }
      }
      if (pixels.count > 0 && (pixels.count == LitPixels::kRoom || seen[n].surface != seen[first].surface))
        flush(n);
      add_pixel(seen[n].surface, seen[n].triangle, seen[n].x, y, pixels);
    }
    if (pixels.count > 0) flush(seen.size());
  }
}

void SurfaceFrame::add_pixel(std::size_t number, std::size_t triangle, int x, int y, LitPixels& to) const {
  const LitSurface& surface = surfaces_[number];
  const Projected& projected = projected_[number];
  const TriangleIndices& corners = surface.triangles[triangle];
  const auto vertex = [&](std::size_t n) { return projected.vertices[static_cast<std::size_t>(corners[n])]; };
  const ScreenVertex a = vertex(0);
  const ScreenVertex b = vertex(1);
  const ScreenVertex c = vertex(2);
  std::array<float, 3> weights{};
  if ((a.outside | b.outside | c.outside) == 0) {
    const std::array<std::int64_t, 3> w = weights_at(a, b, c, x, y);
    for (std::size_t n = 0; n < 3; ++n) weights[n] = static_cast<float>(w[n]);
  } else {
    const auto clip = [&](std::size_t n) {
      return transformed(projected.to_clip, Vec3(surface.positions[static_cast<std::size_t>(corners[n])]));
    };
    const std::array<double, 3> w =
        weights_at(clip(0), clip(1), clip(2), 2 * (x + 0.5) / width_ - 1, 1 - 2 * (y + 0.5) / height_);
    // In clip space y points up: the winding is the other one.
    const double scale = -std::max({std::abs(w[0]), std::abs(w[1]), std::abs(w[2])});
    for (std::size_t n = 0; n < 3; ++n) weights[n] = static_cast<float>(w[n] / scale);
  }
  // Rows of the picture count downwards: counter-clockwise as seen is a negative sum.
  const bool is_front = (weights[0] + weights[1] + weights[2] < 0) != projected.mirrors;
  const std::size_t at = to.count++;
  to.side[at] = is_front ? 1.0F : -1.0F;
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec3f& normal = surface.normals[static_cast<std::size_t>(corners[n])];
    to.x[n][at] = normal.x;
    to.y[n][at] = normal.y;
    to.z[n][at] = normal.z;
    to.weight[n][at] = weights[n];
  }
}

}  // namespace footwall::render
