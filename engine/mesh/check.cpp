#include "engine/mesh/check.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "storage/base/hash.h"

namespace footwall::mesh {

std::vector<std::string> problems_of(const Mesh& mesh, std::size_t limit) {
  std::vector<std::string> found;
  auto tell = [&](std::string problem) {
    if (found.size() < limit) found.push_back(std::move(problem));
  };
  // 1. Faces: vertices and edges that are there, and edges that join these vertices.
  std::map<std::pair<VertexId, VertexId>, FaceId> runs;  // directed
  std::map<VertexId, std::vector<FaceId>> around;
  std::int32_t faces = 0;
  for (FaceId f = 0; f < mesh.face_limit(); ++f) {
    if (!mesh.has_face(f)) continue;
    ++faces;
    const Face& face = mesh.face(f);
    for (int k = 0; k < 3; ++k) {
      const VertexId a = face.vertices[k], b = face.vertices[(k + 1) % 3];
      if (a == b) tell(fmt::format("face {} names vertex {} twice", f, a));
      if (!mesh.has_vertex(a)) tell(fmt::format("face {} names vertex {}, which is not there", f, a));
      around[a].push_back(f);
      if (!runs.emplace(std::pair{a, b}, f).second)
        tell(fmt::format("two faces run from vertex {} to {}, one of them is {}", a, b, f));
      if (!mesh.has_edge(face.edges[k])) {
        tell(fmt::format("face {} names edge {}, which is not there", f, face.edges[k]));
        continue;
      }
      const Edge& e = mesh.edge(face.edges[k]);
      const int side = e.vertices[0] == a ? 0 : 1;
      if (e.vertices[side] != a || e.vertices[1 - side] != b || e.faces[side] != f)
        tell(fmt::format("face {} and its edge {} do not agree", f, face.edges[k]));
    }
  }
  // 2. Edges: both directions as the faces run them.
  std::set<std::pair<VertexId, VertexId>> seen;
  std::int32_t edges = 0;
  for (EdgeId id = 0; id < mesh.edge_limit(); ++id) {
    if (!mesh.has_edge(id)) continue;
    ++edges;
    const Edge& e = mesh.edge(id);
    if (!seen.insert(std::minmax(e.vertices[0], e.vertices[1])).second)
      tell(fmt::format("edge {} stands twice", id));
    for (int side = 0; side < 2; ++side) {
      const auto run = runs.find({e.vertices[side], e.vertices[1 - side]});
      if ((run == runs.end() ? kNone : run->second) != e.faces[side])
        tell(fmt::format("edge {} has the wrong face on side {}", id, side));
    }
    if (e.faces[0] == kNone && e.faces[1] == kNone) tell(fmt::format("edge {} has no face", id));
  }
  // 3. Vertices: one fan, reached by crossing edges at the vertex; a fan_start that starts it.
  std::int32_t vertices = 0;
  for (VertexId v = 0; v < mesh.vertex_limit(); ++v) {
    if (!mesh.has_vertex(v)) continue;
    ++vertices;
    const auto& p = mesh.position(v);
    if (!std::isfinite(p.i) || !std::isfinite(p.j) || !std::isfinite(p.k))
      tell(fmt::format("vertex {} is not at a finite position", v));
    const auto& fan = around[v];
    if (fan.empty() != mesh.is_lone_vertex(v)) tell(fmt::format("vertex {} does not know its faces", v));
    if (fan.empty() || mesh.is_lone_vertex(v)) continue;
    std::set<FaceId> reached{fan.front()};
    std::vector<FaceId> queue{fan.front()};
    bool border = false;
    while (!queue.empty()) {
      const Face face = mesh.face(queue.back());
      queue.pop_back();
      for (int k = 0; k < 3; ++k) {
        const VertexId a = face.vertices[k], b = face.vertices[(k + 1) % 3];
        if (a != v && b != v) continue;
        const auto other = runs.find({b, a});
        if (other == runs.end()) {
          border = true;
        } else if (reached.insert(other->second).second) {
          queue.push_back(other->second);
        }
      }
    }
    if (reached.size() != fan.size())
      tell(fmt::format("the faces around vertex {} form more than one fan", v));
    const EdgeId start = mesh.fan_start(v);
    if (!mesh.has_edge(start)) {
      tell(fmt::format("vertex {} starts at edge {}, which is not there", v, start));
      continue;
    }
    const Edge& e = mesh.edge(start);
    const int side = e.vertices[0] == v ? 0 : 1;
    if (e.vertices[side] != v || e.faces[side] == kNone || (border && e.faces[1 - side] != kNone))
      tell(fmt::format("vertex {} does not start its fan at edge {}", v, start));
  }
  if (faces != mesh.face_count() || edges != mesh.edge_count() || vertices != mesh.vertex_count())
    tell(fmt::format("there are {} vertices, {} edges and {} faces, but the mesh counts otherwise", vertices,
                     edges, faces));
  return found;
}

std::uint64_t state_hash(const Mesh& mesh) {
  Hasher hasher;
  const auto add = [&](const auto& value) { hasher.add(std::as_bytes(std::span(&value, 1))); };
  add(std::array{mesh.vertex_limit(), mesh.edge_limit(), mesh.face_limit(), mesh.vertex_count(),
                 mesh.edge_count(), mesh.face_count()});
  for (VertexId v = 0; v < mesh.vertex_limit(); ++v) {
    if (!mesh.has_vertex(v)) continue;
    const auto& p = mesh.position(v);
    add(std::array{v, mesh.fan_start(v)});
    add(std::array{p.i, p.j, p.k});
  }
  for (EdgeId e = 0; e < mesh.edge_limit(); ++e) {
    if (!mesh.has_edge(e)) continue;
    add(e);
    add(mesh.edge(e));
  }
  for (FaceId f = 0; f < mesh.face_limit(); ++f) {
    if (!mesh.has_face(f)) continue;
    add(f);
    add(mesh.face(f));
  }
  return hasher.value();
}

}  // namespace footwall::mesh
