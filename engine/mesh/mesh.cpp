#include "engine/mesh/mesh.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/mesh/walk.h"
#include "storage/base/error.h"

namespace footwall::mesh {
namespace {

using survey::IndexPoint;

[[noreturn]] void refuse(std::string message, std::string hint = {}) {
  throw Error(ErrorCode::kInvalid, std::move(message), std::move(hint));
}

void check_finite(const IndexPoint& p, std::int64_t vertex) {
  if (!std::isfinite(p.i) || !std::isfinite(p.j) || !std::isfinite(p.k))
    refuse(fmt::format("the position of mesh vertex {} is not finite", vertex));
}

[[noreturn]] void refuse_to_pinch(VertexId vertex) {
  refuse(fmt::format("without the removed faces, mesh parts would meet in vertex {} alone", vertex),
         "remove the faces on one side of that vertex as well");
}

int corner_of(const Face& face, VertexId vertex) {
  return face.vertices[0] == vertex ? 0 : face.vertices[1] == vertex ? 1 : 2;
}

int side_of(const Edge& edge, FaceId face) {
  return edge.faces[0] == face ? 0 : 1;
}

// Half an edge of a face list: face f runs from -> to along its corner.
struct Half {
  VertexId low, high;
  FaceId face;
  int corner;
  bool forward;  // from low to high
};

std::vector<Half> sorted_halves(std::span<const std::array<VertexId, 3>> faces) {
  std::vector<Half> halves;
  halves.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const VertexId a = faces[f][k], b = faces[f][(k + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), static_cast<FaceId>(f), k, a < b});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const Half& x, const Half& y) {
    return std::tie(x.low, x.high, x.face, x.corner) < std::tie(y.low, y.high, y.face, y.corner);
  });
  return halves;
}

}  // namespace

Mesh::Mesh(std::span<const IndexPoint> positions, std::span<const std::array<VertexId, 3>> faces) {
  constexpr std::size_t kMost = 1u << 29;  // so that edge ids fit int32
  if (positions.size() > kMost || faces.size() > kMost)
    throw Error(ErrorCode::kMemory, "the mesh has more than 2^29 vertices or faces");
  std::vector<std::int32_t> uses(positions.size(), 0);
  for (std::size_t v = 0; v < positions.size(); ++v) check_finite(positions[v], static_cast<std::int64_t>(v));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& t = faces[f];
    for (VertexId v : t) {
      if (!in(v, positions.size()))
        refuse(fmt::format("mesh face {} names vertex {}, which is not there", f, v));
      ++uses[v];
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      refuse(fmt::format("mesh face {} names a vertex twice", f));
  }
  vertices_.resize(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) vertices_[v].position = positions[v];
  faces_.resize(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) faces_[f].vertices = faces[f];

  const std::vector<Half> halves = sorted_halves(faces);
  for (std::size_t first = 0; first < halves.size();) {
    const Half& h = halves[first];
    std::size_t last = first + 1;
    while (last < halves.size() && halves[last].low == h.low && halves[last].high == h.high) ++last;
    if (last - first > 2)
      refuse(
          fmt::format("the mesh edge between vertices {} and {} has {} faces", h.low, h.high, last - first));
    if (last - first == 2 && h.forward == halves[first + 1].forward)
      refuse(fmt::format("mesh faces {} and {} run their common edge ({}, {}) in the same direction", h.face,
                         halves[first + 1].face, h.low, h.high));
    const VertexId from = h.forward ? h.low : h.high, to = h.forward ? h.high : h.low;
    const EdgeId e = new_edge(from, to, h.face);
    faces_[h.face].edges[h.corner] = e;
    if (last - first == 2) {
      edges_[e].faces[1] = halves[first + 1].face;
      faces_[halves[first + 1].face].edges[halves[first + 1].corner] = e;
    }
    first = last;
  }
  face_count_ = static_cast<std::int32_t>(faces.size());
  for (FaceId f = 0; f < face_limit(); ++f) {
    for (VertexId v : faces_[f].vertices) {
      if (vertices_[v].edge != kNone) continue;
      refresh_vertex(v, f);
      ++vertex_count_;
      if (std::cmp_not_equal(faces_of(*this, v).size(), uses[v]))
        refuse(fmt::format("the faces around mesh vertex {} form more than one fan", v));
    }
  }
}

AddedFace Mesh::add_triangle(const std::array<IndexPoint, 3>& positions) {
  for (int k = 0; k < 3; ++k) check_finite(positions[k], vertex_limit() + k);
  std::array<VertexId, 3> v;
  for (int k = 0; k < 3; ++k) v[k] = new_vertex(positions[k]);
  const FaceId f = face_limit();
  std::array<EdgeId, 3> e;
  for (int k = 0; k < 3; ++k) e[k] = new_edge(v[k], v[(k + 1) % 3], f);
  new_face(v, e);
  for (VertexId each : v) refresh_vertex(each, f);
  return {f, v[2]};
}

AddedFace Mesh::add_face(EdgeId border_edge, const IndexPoint& position) {
  check_finite(position, vertex_limit());
  if (!is_border_edge(border_edge)) refuse(fmt::format("mesh edge {} has faces on both sides", border_edge));
  const int side = edges_[border_edge].faces[0] == kNone ? 0 : 1;
  const VertexId a = edges_[border_edge].vertices[side], b = edges_[border_edge].vertices[1 - side];
  const VertexId w = new_vertex(position);
  const FaceId f = face_limit();
  edges_[border_edge].faces[side] = f;
  const EdgeId bw = new_edge(b, w, f);
  const EdgeId wa = new_edge(w, a, f);
  new_face({a, b, w}, {border_edge, bw, wa});
  // At a the face ends the fan, at b it starts it, at w it is the fan.
  vertices_[b].edge = bw;
  vertices_[w].edge = wa;
  return {f, w};
}

AddedFace Mesh::add_face(EdgeId border_edge, VertexId vertex) {
  if (!is_border_edge(border_edge)) refuse(fmt::format("mesh edge {} has faces on both sides", border_edge));
  const VertexId w = vertex;
  if (!is_lone_vertex(w) && !is_border_vertex(w))
    refuse(fmt::format("mesh vertex {} is not on the border", w));
  const int side = edges_[border_edge].faces[0] == kNone ? 0 : 1;
  const VertexId a = edges_[border_edge].vertices[side], b = edges_[border_edge].vertices[1 - side];
  if (w == a || w == b) refuse(fmt::format("mesh vertex {} is an end of edge {}", w, border_edge));
  const Face& neighbour = faces_[edges_[border_edge].faces[1 - side]];
  if (std::find(neighbour.vertices.begin(), neighbour.vertices.end(), w) != neighbour.vertices.end())
    refuse(fmt::format("a mesh face on the vertices {}, {} and {} is there already", a, b, w));

  // An edge that is there already must be free in the new face's direction.
  auto sewn = [&](VertexId from, VertexId to) {
    const EdgeId e = edge_between(*this, from, to);
    if (e == kNone) return e;
    if (edges_[e].faces[edges_[e].vertices[0] == from ? 0 : 1] != kNone)
      refuse(fmt::format("the mesh edge from vertex {} to {} has a face on that side already", from, to));
    return e;
  };
  EdgeId bw = sewn(b, w);
  EdgeId wa = sewn(w, a);
  if (bw == kNone && wa == kNone && !is_lone_vertex(w))
    refuse(fmt::format("the face would touch the mesh at vertex {} in that point alone", w));

  const FaceId f = face_limit();
  edges_[border_edge].faces[side] = f;
  auto attach = [&](EdgeId e, VertexId from, VertexId to) {
    if (e == kNone) return new_edge(from, to, f);
    edges_[e].faces[edges_[e].vertices[0] == from ? 0 : 1] = f;
    return e;
  };
  bw = attach(bw, b, w);
  wa = attach(wa, w, a);
  new_face({a, b, w}, {border_edge, bw, wa});
  for (VertexId each : {a, b, w}) refresh_vertex(each, f);
  return {f, w};
}

EdgeSplit Mesh::split_edge(EdgeId id, const IndexPoint& position) {
  check_finite(position, vertex_limit());
  const Edge old = edge(id);
  const VertexId b = old.vertices[1];
  EdgeSplit split;
  const VertexId m = split.vertex = new_vertex(position);
  const EdgeId mb = split.edge = new_edge(m, b, kNone);
  edges_[id].vertices[1] = m;
  if (vertices_[b].edge == id) vertices_[b].edge = mb;
  // The new vertex's fan starts at a border edge that leaves it with its face to the left.
  vertices_[m].edge = old.faces[0] == kNone ? id : mb;
  for (int side = 0; side < 2; ++side) {
    const FaceId f = old.faces[side];
    if (f == kNone) continue;
    // The face (from, to, apex) keeps its id where it keeps a.
    const int k = corner_of(faces_[f], old.vertices[side]);
    const VertexId apex = faces_[f].vertices[(k + 2) % 3];
    const EdgeId after = faces_[f].edges[(k + 1) % 3], before = faces_[f].edges[(k + 2) % 3];
    const FaceId g = split.faces[side] = face_limit();
    const EdgeId inner = new_edge(m, apex, kNone);
    const EdgeId far = side == 0 ? after : before;  // from b to the apex, or back
    edges_[far].faces[side_of(edges_[far], f)] = g;
    edges_[mb].faces[side] = g;
    if (side == 0) {
      edges_[inner].faces = {f, g};
      new_face({m, b, apex}, {mb, after, inner});
      faces_[f].vertices[(k + 1) % 3] = m;
      faces_[f].edges[(k + 1) % 3] = inner;
    } else {
      edges_[inner].faces = {g, f};
      new_face({b, m, apex}, {mb, inner, before});
      faces_[f].vertices[k] = m;
      faces_[f].edges[(k + 2) % 3] = inner;
    }
  }
  return split;
}

void Mesh::remove_faces(std::span<const FaceId> faces) {
  remove(faces, Unused::kRemove);
}

void Mesh::remove_face(FaceId face) {
  remove_one(face, Unused::kRemove);
}

std::vector<FaceId> Mesh::remove_faces_around(VertexId vertex) {
  position(vertex);
  std::vector<FaceId> gone = faces_of(*this, vertex);
  if (gone.size() == 1) {
    remove_one(gone.front(), Unused::kKeep);
  } else {
    remove(gone, Unused::kKeep);
  }
  vertices_[vertex].edge = kNone;
  --vertex_count_;
  return gone;
}

// In constant time: around each of its vertices, whether the face's two edges are on the border tells whether
// it is an end of the fan, all of it, or inside.
void Mesh::remove_one(FaceId id, Unused unused) {
  const Face gone = face(id);
  const auto on_border = [&](int k) { return is_border_edge(gone.edges[k % 3]); };
  for (int k = 0; k < 3; ++k) {
    if (!on_border(k) && !on_border(k + 2) && is_border_vertex(gone.vertices[k]))
      refuse_to_pinch(gone.vertices[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const VertexId v = gone.vertices[k];
    if (on_border(k) && on_border(k + 2)) {
      leave_vertex(v, unused);
    } else if (!on_border(k + 2)) {
      vertices_[v].edge = gone.edges[(k + 2) % 3];  // the face was first, or the fan was closed
    }
  }
  for (const EdgeId e : gone.edges) detach(e, id);
  faces_[id] = Face{};
  --face_count_;
}

void Mesh::remove(std::span<const FaceId> faces, Unused unused) {
  std::vector<FaceId> gone(faces.begin(), faces.end());
  std::sort(gone.begin(), gone.end());
  for (std::size_t n = 0; n < gone.size(); ++n) {
    face(gone[n]);
    if (n > 0 && gone[n] == gone[n - 1]) refuse(fmt::format("mesh face {} is to be removed twice", gone[n]));
  }
  auto stays = [&](FaceId f) { return !std::binary_search(gone.begin(), gone.end(), f); };

  // 1. What is left around each touched vertex must be one run of its fan.
  std::vector<std::pair<VertexId, FaceId>> touched;  // with a face that stays there
  for (FaceId f : gone)
    for (VertexId v : faces_[f].vertices) touched.emplace_back(v, kNone);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (auto& [v, left] : touched) {
    const std::vector<FaceId> fan = faces_of(*this, v);
    const bool open = is_border_vertex(v);
    int runs = 0;
    for (std::size_t n = 0; n < fan.size(); ++n) {
      if (!stays(fan[n])) continue;
      left = fan[n];
      const bool starts = n > 0 ? !stays(fan[n - 1]) : (open || !stays(fan.back()));
      runs += starts;
    }
    if (runs > 1) refuse_to_pinch(v);
  }
  // 2. Take them out.
  for (FaceId f : gone) {
    for (EdgeId e : faces_[f].edges) detach(e, f);
    faces_[f] = Face{};
    --face_count_;
  }
  for (const auto& [v, left] : touched) {
    if (left != kNone) {
      refresh_vertex(v, left);
    } else {
      leave_vertex(v, unused);
    }
  }
}

void Mesh::leave_vertex(VertexId vertex, Unused unused) {
  vertices_[vertex].edge = unused == Unused::kKeep ? kLone : kNone;
  if (unused == Unused::kRemove) --vertex_count_;
}

void Mesh::detach(EdgeId id, FaceId face) {
  Edge& e = edges_[id];
  e.faces[side_of(e, face)] = kNone;
  if (e.faces[0] != kNone || e.faces[1] != kNone) return;
  e = Edge{};
  --edge_count_;
}

void Mesh::move_vertex(VertexId vertex, const IndexPoint& to) {
  position(vertex);
  check_finite(to, vertex);
  vertices_[vertex].position = to;
}

const IndexPoint& Mesh::position(VertexId vertex) const {
  if (!has_vertex(vertex)) refuse(fmt::format("there is no mesh vertex {}", vertex));
  return vertices_[vertex].position;
}

const Edge& Mesh::edge(EdgeId id) const {
  if (!has_edge(id)) refuse(fmt::format("there is no mesh edge {}", id));
  return edges_[id];
}

const Face& Mesh::face(FaceId id) const {
  if (!has_face(id)) refuse(fmt::format("there is no mesh face {}", id));
  return faces_[id];
}

Wings Mesh::wings(EdgeId id) const {
  const Edge& e = edge(id);
  Wings wings;
  if (e.faces[0] != kNone) {
    const Face& left = faces_[e.faces[0]];
    const int k = corner_of(left, e.vertices[0]);
    wings.left_before = left.edges[(k + 2) % 3];
    wings.left_after = left.edges[(k + 1) % 3];
  }
  if (e.faces[1] != kNone) {
    const Face& right = faces_[e.faces[1]];
    const int k = corner_of(right, e.vertices[1]);
    wings.right_before = right.edges[(k + 2) % 3];
    wings.right_after = right.edges[(k + 1) % 3];
  }
  return wings;
}

EdgeId Mesh::next_edge(FaceId id, EdgeId edge) const {
  return face(id).edges[(place_of(id, edge) + 1) % 3];
}

EdgeId Mesh::previous_edge(FaceId id, EdgeId edge) const {
  return face(id).edges[(place_of(id, edge) + 2) % 3];
}

int Mesh::place_of(FaceId id, EdgeId edge) const {
  const auto& edges = face(id).edges;
  const auto found = std::find(edges.begin(), edges.end(), edge);
  if (found == edges.end()) refuse(fmt::format("mesh face {} has no edge {}", id, edge));
  return static_cast<int>(found - edges.begin());
}

EdgeId Mesh::fan_start(VertexId vertex) const {
  position(vertex);
  return vertices_[vertex].edge == kLone ? kNone : vertices_[vertex].edge;
}

bool Mesh::is_border_edge(EdgeId id) const {
  const Edge& e = edge(id);
  return e.faces[0] == kNone || e.faces[1] == kNone;
}

bool Mesh::is_border_vertex(VertexId vertex) const {
  const EdgeId start = fan_start(vertex);
  return start != kNone && is_border_edge(start);
}

EdgeId Mesh::new_edge(VertexId from, VertexId to, FaceId left) {
  edges_.push_back({{from, to}, {left, kNone}});
  ++edge_count_;
  return edge_limit() - 1;
}

FaceId Mesh::new_face(const std::array<VertexId, 3>& vertices, const std::array<EdgeId, 3>& edges) {
  faces_.push_back({vertices, edges});
  ++face_count_;
  return face_limit() - 1;
}

VertexId Mesh::new_vertex(const IndexPoint& position) {
  vertices_.push_back({position, kNone});
  ++vertex_count_;
  return vertex_limit() - 1;
}

// Turns clockwise from `start` to the border, or once around.
void Mesh::refresh_vertex(VertexId vertex, FaceId start) {
  FaceId f = start;
  for (;;) {
    const EdgeId leaving = faces_[f].edges[corner_of(faces_[f], vertex)];
    vertices_[vertex].edge = leaving;
    const FaceId next = edges_[leaving].faces[1 - side_of(edges_[leaving], f)];
    if (next == kNone || next == start) return;
    f = next;
  }
}

}  // namespace footwall::mesh
