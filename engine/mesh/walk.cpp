#include "engine/mesh/walk.h"

#include <algorithm>
#include <numeric>

namespace footwall::mesh {
namespace {

int corner_of(const Face& face, VertexId vertex) {
  return face.vertices[0] == vertex ? 0 : face.vertices[1] == vertex ? 1 : 2;
}

// The face in which the edge leaves the vertex.
FaceId first_face(const Mesh& mesh, VertexId vertex, EdgeId start) {
  const Edge& e = mesh.edge(start);
  return e.vertices[0] == vertex ? e.faces[0] : e.faces[1];
}

}  // namespace

FaceId across(const Mesh& mesh, FaceId face, EdgeId edge) {
  mesh.face(face);
  const Edge& e = mesh.edge(edge);
  return e.faces[0] == face ? e.faces[1] : e.faces[0];
}

std::vector<FaceId> faces_of(const Mesh& mesh, VertexId vertex) {
  std::vector<FaceId> fan;
  append_faces_of(mesh, vertex, fan);
  return fan;
}

void append_faces_of(const Mesh& mesh, VertexId vertex, std::vector<FaceId>& fan) {
  const EdgeId start = mesh.fan_start(vertex);
  if (start == kNone) return;
  const FaceId first = first_face(mesh, vertex, start);
  FaceId f = first;
  do {
    fan.push_back(f);
    const Face& face = mesh.face(f);
    f = across(mesh, f, face.edges[(corner_of(face, vertex) + 2) % 3]);
  } while (f != kNone && f != first);
}

std::vector<EdgeId> edges_of(const Mesh& mesh, VertexId vertex) {
  std::vector<EdgeId> edges;
  const std::vector<FaceId> fan = faces_of(mesh, vertex);
  for (FaceId f : fan) {
    const Face& face = mesh.face(f);
    edges.push_back(face.edges[corner_of(face, vertex)]);
  }
  if (fan.empty()) return edges;
  const Face& last = mesh.face(fan.back());
  const EdgeId end = last.edges[(corner_of(last, vertex) + 2) % 3];
  if (end != edges.front()) edges.push_back(end);
  return edges;
}

EdgeId edge_between(const Mesh& mesh, VertexId a, VertexId b) {
  mesh.position(b);
  for (EdgeId e : edges_of(mesh, a)) {
    const Edge& edge = mesh.edge(e);
    if (edge.vertices[0] == b || edge.vertices[1] == b) return e;
  }
  return kNone;
}

std::vector<std::vector<VertexId>> boundary_loops(const Mesh& mesh) {
  // A border vertex has a single fan, so that one border edge leaves it with its face to the left: its
  // fan_start.
  std::vector<std::vector<VertexId>> loops;
  std::vector<bool> done(mesh.vertex_limit(), false);
  for (VertexId v = 0; v < mesh.vertex_limit(); ++v) {
    if (!mesh.has_vertex(v) || done[v] || !mesh.is_border_vertex(v)) continue;
    std::vector<VertexId> loop;
    for (VertexId at = v; !done[at];) {
      done[at] = true;
      loop.push_back(at);
      const Edge& e = mesh.edge(mesh.fan_start(at));
      at = e.vertices[0] == at ? e.vertices[1] : e.vertices[0];
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<std::vector<FaceId>> components(const Mesh& mesh) {
  std::vector<std::vector<FaceId>> pieces;
  std::vector<bool> done(mesh.face_limit(), false);
  for (FaceId f = 0; f < mesh.face_limit(); ++f) {
    if (!mesh.has_face(f) || done[f]) continue;
    std::vector<FaceId> piece{f};
    done[f] = true;
    for (std::size_t n = 0; n < piece.size(); ++n) {
      for (EdgeId e : mesh.face(piece[n]).edges) {
        const FaceId next = across(mesh, piece[n], e);
        if (next == kNone || done[next]) continue;
        done[next] = true;
        piece.push_back(next);
      }
    }
    std::sort(piece.begin(), piece.end());
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace footwall::mesh
