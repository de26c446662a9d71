// A surface in the making, as the serial variants build theirs: lists that grow, handed over at the end.
#pragma once
#include <string_view>
#include <vector>

#include "engine/isosurface/detail/vertex_arithmetic.h"
#include "engine/isosurface/extract.h"

namespace footwall::isosurface::detail {

class Draft {
 public:
  // Throws what extract() throws for its input, and kUnsupported for options.bricks, naming the variant.
  Draft(const Field& field, float isovalue, const ExtractOptions& options, std::string_view variant);

  // Indices count from the field's first sample. cells: those to look at, may be empty; samples: theirs.
  const Field& field;
  const float isovalue;
  const bool normals;
  survey::Box cells;
  survey::Box samples;
  const float* at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return field.values.data() + (i * field.size[1] + j) * field.size[2] + k;
  }
  std::int64_t step(int axis) const {
    return axis == 0 ? field.size[1] * field.size[2] : axis == 1 ? field.size[2] : 1;
  }
  // Twice the gradient, see vertex_arithmetic.h.
  Point gradient_at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return twice_gradient(field, i, j, k);
  }

  // The vertex at t of the edge from (i, j, k) along `axis`; the normal is left out where none are asked for.
  // Returns its number. Throws kUnsupported for too many.
  std::uint32_t add_vertex(int axis, std::int64_t i, std::int64_t j, std::int64_t k, float t,
                           const Point& normal);
  // A cell's centre vertex gets its number first, and its place later, when those around it have theirs.
  std::uint32_t reserve_centre(std::int64_t i, std::int64_t j, std::int64_t k);
  // loop: the numbers of the vertices around it, by ascending edge.
  void place_centre(std::uint32_t number, std::span<const std::uint32_t> loop);
  // Before the triangles of each row of cells, in order.
  void begin_row() { row_first.push_back(triangles.size()); }

  // Puts vertices that were found in another order into that of Surface.
  void sort_vertices();
  void hand_over(Surface& into);

  std::vector<Point> positions, normal_vectors;
  std::vector<VertexKey> keys;  // of all vertices, whether asked for or not
  std::vector<Triangle> triangles;
  std::vector<std::uint64_t> row_first;

 private:
  std::uint32_t next_number() const;
  VertexKey key(std::int64_t i, std::int64_t j, std::int64_t k, int axis) const;
  const bool hands_over_keys_;
  survey::Box marched_;  // cells as the volume counts them
};

}  // namespace footwall::isosurface::detail
