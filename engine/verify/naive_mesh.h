// A mesh as a list of triangles, and its operators by definition: an operation is refused where the list that
// it would leave is not manifold and consistently oriented, which is looked up in the whole list each time.
// Slow and obvious; what engine/mesh is compared with.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "storage/survey/points.h"

namespace footwall::verify {

class NaiveMesh {
 public:
  using Corners = std::array<std::int32_t, 3>;

  // CREATE-MESH of one triangle.
  explicit NaiveMesh(const std::array<survey::LatticePoint, 3>& corners);

  // Each returns whether it was done; where not, nothing changed. Edges are named by their ends, in any
  // order.
  bool add_face(std::int32_t a, std::int32_t b, const survey::LatticePoint& apex);
  bool add_face(std::int32_t a, std::int32_t b, std::int32_t vertex);
  bool remove_faces(std::int32_t vertex);
  bool remove_face(std::int32_t face);
  bool move_vertex(std::int32_t vertex, const survey::LatticePoint& to);
  // `a` is the end whose faces keep their ids; the new faces' ids go first to the one that runs a -> b.
  bool split_edge(std::int32_t a, std::int32_t b, const survey::LatticePoint& at);

  const std::map<std::int32_t, Corners>& faces() const { return faces_; }
  const std::map<std::int32_t, survey::LatticePoint>& vertices() const { return vertices_; }
  std::int32_t next_face() const { return next_face_; }
  std::int32_t next_vertex() const { return next_vertex_; }
  std::size_t edge_count() const;

 private:
  // The direction in which a new face would run the edge, where exactly one face has it.
  std::optional<std::array<std::int32_t, 2>> free_direction(std::int32_t a, std::int32_t b) const;
  std::optional<std::int32_t> face_running(std::int32_t from, std::int32_t to) const;
  bool has_faces(std::int32_t vertex) const;

  std::map<std::int32_t, Corners> faces_;
  std::map<std::int32_t, survey::LatticePoint> vertices_;
  std::int32_t next_face_ = 0;
  std::int32_t next_vertex_ = 0;
};

}  // namespace footwall::verify
