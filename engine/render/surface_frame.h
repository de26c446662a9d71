// One picture of lit surfaces, step by step: project the vertices, rasterize the triangles into a visibility
// buffer, shade what is seen. Each step may run on several threads; none of them changes a bit.
#pragma once
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "engine/render/light_pixels.h"
#include "engine/render/lit_surface.h"
#include "engine/render/visibility.h"

namespace footwall::render {

// Finds the triangle of a primitive's number.
class PrimitiveTable {
 public:
  struct Entry {
    PrimitiveId first_id;
    std::uint32_t surface;
    std::size_t first_triangle;
  };
  void assign(std::span<const LitSurface> surfaces);
  // The entry that `id`, a number of one of the surfaces, falls in.
  const Entry& entry_of(PrimitiveId id) const {
    std::size_t n = buckets_[(id - lowest_) >> shift_];
    while (n + 1 < entries_.size() && entries_[n + 1].first_id <= id) ++n;
    return entries_[n];
  }

  // Has the entry fetched that will be asked for soon; any number.
  void fetch(PrimitiveId id) const {
    const std::size_t bucket = std::min<std::size_t>((id - lowest_) >> shift_, buckets_.size() - 1);
    __builtin_prefetch(&entries_[buckets_[bucket]]);
  }

 private:
  std::vector<Entry> entries_;  // ascending by first_id
  // The last entry at or before the first number of each 2^shift_ numbers from lowest_ on.
  std::vector<std::uint32_t> buckets_;
  PrimitiveId lowest_ = 0;
  unsigned shift_ = 0;
};

// Keeps its room from picture to picture.
class SurfaceFrame {
 public:
  // Projects all vertices to a picture of width x height. The surfaces' arrays must stay until the frame is
  // done; they must be sound (check() in lit_surface.h), which is not looked at again.
  void project(std::span<const LitSurface> surfaces, const Camera& camera, int width, int height,
               int threads);
  // The same in steps, for surfaces that come one after the other: begin() an empty frame, add() each
  // surface, which returns its place, and number() before shade(). keep() changes a surface's triangles and
  // runs before they are drawn, the vertices stay.
  void begin(const Camera& camera, int width, int height);
  std::size_t add(const LitSurface& surface, int threads);
  void keep(std::size_t surface, std::span<const TriangleIndices> triangles, std::span<const IdRun> runs);
  void number() { table_.assign(surfaces_); }
  std::span<const ScreenVertex> vertices_of(std::size_t surface) const {
    return {projected_[surface].vertices.get(), surfaces_[surface].positions.size()};
  }
  // Draws all triangles, of the surfaces from `first` on, into the window, whatever was there before is kept
  // where it is nearer. Several threads take as many windows of memory.
  void rasterize(VisibilityBuffer& window, int threads, std::size_t first = 0) const;
  // The colours of the window's pixels, one each; 0 (transparent) where no surface of this frame is seen.
  // The window must hold numbers of this frame's surfaces alone.
  void shade(const VisibilityBuffer& window, std::span<Rgba> colours, int threads);

  std::size_t triangles() const;
  std::span<const LitSurface> surfaces() const { return surfaces_; }

 private:
  struct Projected {
    std::unique_ptr<ScreenVertex[]> vertices;
    std::size_t room = 0;
    Matrix4 to_clip{};
    std::array<float, 9> to_view{};  // normals_to_view()
    bool mirrors = false;
  };
  void shade_rows(const VisibilityBuffer& window, int begin, int end, std::span<Rgba> colours) const;
  // Adds pixel (x, y), which shows this triangle.
  void add_pixel(std::size_t surface, std::size_t triangle, int x, int y, LitPixels& to) const;

  std::vector<LitSurface> surfaces_;
  std::vector<Projected> projected_;
  PrimitiveTable table_;
  Camera camera_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace footwall::render
