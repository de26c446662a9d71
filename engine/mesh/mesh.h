// A triangle mesh with winged-edge relations: manifold, consistently oriented, with ids that stay.
// Each operator keeps it so or throws Error kInvalid and leaves the mesh as it was.
// Based on: Baumgart, winged edge polyhedron representation, 1972; the operators of seed 004 section 2.7.4.
// Differs in: an edge stores its two vertices and two faces only, the four wings follow from the faces' edge
// cycles; add_face also takes an existing vertex, faces can be removed one by one, edges can be split.
// An operator takes time in proportion to the faces around the vertices that it names, never to the mesh:
// constant where no existing vertex has to be looked for (all but add_face with a vertex, remove_faces).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::mesh {

using VertexId = std::int32_t;
using EdgeId = std::int32_t;
using FaceId = std::int32_t;
inline constexpr std::int32_t kNone = -1;

// An edge runs from vertices[0] to vertices[1]; faces[0] lies to its left (it runs the edge in this
// direction), faces[1] to its right; kNone on the border.
struct Edge {
  std::array<VertexId, 2> vertices{kNone, kNone};
  std::array<FaceId, 2> faces{kNone, kNone};
  friend bool operator==(const Edge&, const Edge&) = default;
};

// Counter-clockwise as seen from the side the normal points to; edges[k] joins vertices[k] and
// vertices[(k+1)%3].
struct Face {
  std::array<VertexId, 3> vertices{kNone, kNone, kNone};
  std::array<EdgeId, 3> edges{kNone, kNone, kNone};
  friend bool operator==(const Face&, const Face&) = default;
};

// The four winged-edge neighbours of an edge: the edges before and after it in its left and in its right
// face.
struct Wings {
  EdgeId left_before = kNone;
  EdgeId left_after = kNone;
  EdgeId right_before = kNone;
  EdgeId right_after = kNone;
  friend bool operator==(const Wings&, const Wings&) = default;
};

struct AddedFace {
  FaceId face = kNone;
  VertexId vertex = kNone;  // the face's vertex off the given edge: new or given
};

// The edge (a, b) became (a, vertex), with the id it had, and `edge` = (vertex, b). Each face beside it kept
// its half at a; `faces` are the halves at b, left and right of the edge, kNone on the border.
struct EdgeSplit {
  VertexId vertex = kNone;
  EdgeId edge = kNone;
  std::array<FaceId, 2> faces{kNone, kNone};
};

// Ids are counted up and never used again, also after removals; *_limit() is one more than the largest ever
// given. Positions are index space (voxels). Not thread-safe while it changes; const calls may run in
// parallel.
class Mesh {
 public:
  Mesh() = default;
  // CREATE-MESH: vertex v and face f get the ids v and f. A vertex of no face stays out: has_vertex() is
  // false. Throws Error kInvalid naming the edge, vertex or face for anything that is not manifold and
  // consistently oriented (see cut_into_manifold), a face that names a vertex twice or one that is not there,
  // or a position that is not finite.
  Mesh(std::span<const survey::IndexPoint> positions, std::span<const std::array<VertexId, 3>> faces);

  // A triangle of its own, with three new vertices.
  AddedFace add_triangle(const std::array<survey::IndexPoint, 3>& positions);
  // ADD-FACE on the free side of a border edge, with a new vertex at `position`.
  AddedFace add_face(EdgeId border_edge, const survey::IndexPoint& position);
  // ADD-FACE with an existing vertex; where that vertex already has a border edge to an end of `border_edge`,
  // the face is sewn to it. Refused unless the vertex is on the border or alone, and every vertex keeps a
  // single fan of faces.
  AddedFace add_face(EdgeId border_edge, VertexId vertex);
  // Inserts a vertex at `position` on an edge; the faces beside it are split.
  EdgeSplit split_edge(EdgeId edge, const survey::IndexPoint& position);
  // All or none; edges and vertices left without a face go with them. Refused where two fans of
  // faces would meet in one vertex only, and for ids that are not there or stand twice.
  void remove_faces(std::span<const FaceId> faces);
  void remove_face(FaceId face);
  // REMOVE-FACES: all faces around a vertex, their edges where no other face has them, and the vertex. Other
  // vertices stay, alone where no face is left to them, so that it can be applied to each vertex of a mesh in
  // turn. Refused as remove_faces. The faces that it took.
  std::vector<FaceId> remove_faces_around(VertexId vertex);
  // MOVE-VERTEX; the position must be finite.
  void move_vertex(VertexId vertex, const survey::IndexPoint& position);

  bool has_vertex(VertexId v) const { return in(v, vertices_.size()) && vertices_[v].edge != kNone; }
  // Whether the vertex is there without a face.
  bool is_lone_vertex(VertexId v) const { return in(v, vertices_.size()) && vertices_[v].edge == kLone; }
  bool has_edge(EdgeId e) const { return in(e, edges_.size()) && edges_[e].vertices[0] != kNone; }
  bool has_face(FaceId f) const { return in(f, faces_.size()) && faces_[f].vertices[0] != kNone; }
  std::int32_t vertex_count() const { return vertex_count_; }
  std::int32_t edge_count() const { return edge_count_; }
  std::int32_t face_count() const { return face_count_; }
  VertexId vertex_limit() const { return static_cast<VertexId>(vertices_.size()); }
  EdgeId edge_limit() const { return static_cast<EdgeId>(edges_.size()); }
  FaceId face_limit() const { return static_cast<FaceId>(faces_.size()); }

  // These throw Error kInvalid for an id that is not there.
  const survey::IndexPoint& position(VertexId vertex) const;
  const Edge& edge(EdgeId edge) const;
  const Face& face(FaceId face) const;
  Wings wings(EdgeId edge) const;
  // The edges before and after an edge in the cycle of a face's edges, counter-clockwise.
  EdgeId next_edge(FaceId face, EdgeId edge) const;
  EdgeId previous_edge(FaceId face, EdgeId edge) const;
  // An edge at the vertex; at a border vertex the border edge with a face counter-clockwise of it; kNone for
  // a lone vertex.
  EdgeId fan_start(VertexId vertex) const;
  bool is_border_edge(EdgeId edge) const;
  // False for a lone vertex.
  bool is_border_vertex(VertexId vertex) const;

 private:
  friend struct MeshTestAccess;  // lets the tests of check.h break a mesh
  struct Vertex {
    survey::IndexPoint position;
    EdgeId edge = kNone;  // fan_start(), kLone without a face, kNone once removed
  };
  static constexpr EdgeId kLone = -2;
  static bool in(std::int32_t id, std::size_t size) { return id >= 0 && static_cast<std::size_t>(id) < size; }

  int place_of(FaceId face, EdgeId edge) const;
  EdgeId new_edge(VertexId from, VertexId to, FaceId left);
  FaceId new_face(const std::array<VertexId, 3>& vertices, const std::array<EdgeId, 3>& edges);
  VertexId new_vertex(const survey::IndexPoint& position);
  void refresh_vertex(VertexId vertex, FaceId face);
  enum class Unused : std::uint8_t { kRemove, kKeep };  // vertices that are left without a face
  void remove(std::span<const FaceId> faces, Unused unused);
  void remove_one(FaceId face, Unused unused);
  void leave_vertex(VertexId vertex, Unused unused);
  void detach(EdgeId edge, FaceId face);

  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  std::int32_t vertex_count_ = 0;
  std::int32_t edge_count_ = 0;
  std::int32_t face_count_ = 0;
};

}  // namespace footwall::mesh
