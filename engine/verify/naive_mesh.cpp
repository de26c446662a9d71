#include "engine/verify/naive_mesh.h"

#include <algorithm>
#include <set>
#include <vector>

namespace footwall::verify {
namespace {

using Corners = NaiveMesh::Corners;
using Faces = std::map<std::int32_t, Corners>;

bool names(const Corners& face, std::int32_t vertex) {
  return std::find(face.begin(), face.end(), vertex) != face.end();
}

// Whether the faces around a vertex hang together by edges at it.
bool single_fan(const Faces& faces, std::int32_t vertex) {
  std::vector<Corners> left;
  for (const auto& [id, face] : faces) {
    if (names(face, vertex)) left.push_back(face);
  }
  if (left.empty()) return true;
  std::vector<Corners> reached{left.back()};
  left.pop_back();
  for (std::size_t n = 0; n < reached.size(); ++n) {
    const auto shares_an_edge = [&](const Corners& other) {
      return std::count_if(other.begin(), other.end(),
                           [&](std::int32_t v) { return names(reached[n], v); }) >= 2;
    };
    for (std::size_t m = left.size(); m-- > 0;) {
      if (!shares_an_edge(left[m])) continue;
      reached.push_back(left[m]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(m));
    }
  }
  return left.empty();
}

// No two faces on the same vertices, no direction of an edge run twice, one fan at every vertex.
bool sound(const Faces& faces) {
  std::set<std::array<std::int32_t, 2>> runs;
  std::set<std::set<std::int32_t>> triples;
  std::set<std::int32_t> vertices;
  for (const auto& [id, face] : faces) {
    const std::set<std::int32_t> triple(face.begin(), face.end());
    if (triple.size() != 3 || !triples.insert(triple).second) return false;
    vertices.insert(face.begin(), face.end());
    for (std::size_t k = 0; k < 3; ++k) {
      if (!runs.insert({face[k], face[(k + 1) % 3]}).second) return false;
    }
  }
  return std::all_of(vertices.begin(), vertices.end(), [&](std::int32_t v) { return single_fan(faces, v); });
}

}  // namespace

NaiveMesh::NaiveMesh(const std::array<survey::LatticePoint, 3>& corners) {
  for (const survey::LatticePoint& p : corners) vertices_[next_vertex_++] = p;
  faces_[next_face_++] = {0, 1, 2};
}

std::optional<std::int32_t> NaiveMesh::face_running(std::int32_t from, std::int32_t to) const {
  for (const auto& [id, face] : faces_) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (face[k] == from && face[(k + 1) % 3] == to) return id;
    }
  }
  return std::nullopt;
}

std::optional<std::array<std::int32_t, 2>> NaiveMesh::free_direction(std::int32_t a, std::int32_t b) const {
  const bool forward = face_running(a, b).has_value(), backward = face_running(b, a).has_value();
  if (forward == backward) return std::nullopt;
  return forward ? std::array{b, a} : std::array{a, b};
}

bool NaiveMesh::has_faces(std::int32_t vertex) const {
  return std::any_of(faces_.begin(), faces_.end(),
                     [&](const auto& face) { return names(face.second, vertex); });
}

bool NaiveMesh::add_face(std::int32_t a, std::int32_t b, const survey::LatticePoint& apex) {
  const auto direction = free_direction(a, b);
  if (!direction) return false;
  vertices_[next_vertex_] = apex;
  faces_[next_face_++] = {(*direction)[0], (*direction)[1], next_vertex_++};
  return true;
}

bool NaiveMesh::add_face(std::int32_t a, std::int32_t b, std::int32_t vertex) {
  const auto direction = free_direction(a, b);
  if (!direction || !vertices_.contains(vertex)) return false;
  Faces after = faces_;
  after[next_face_] = {(*direction)[0], (*direction)[1], vertex};
  if (!sound(after)) return false;
  faces_ = std::move(after);
  ++next_face_;
  return true;
}

bool NaiveMesh::remove_faces(std::int32_t vertex) {
  if (!vertices_.contains(vertex)) return false;
  Faces after = faces_;
  std::erase_if(after, [&](const auto& face) { return names(face.second, vertex); });
  if (!sound(after)) return false;
  faces_ = std::move(after);
  vertices_.erase(vertex);
  return true;
}

bool NaiveMesh::remove_face(std::int32_t face) {
  Faces after = faces_;
  const auto found = after.find(face);
  if (found == after.end()) return false;
  const Corners corners = found->second;
  after.erase(found);
  if (!sound(after)) return false;
  faces_ = std::move(after);
  for (const std::int32_t v : corners) {
    if (!has_faces(v)) vertices_.erase(v);
  }
  return true;
}

bool NaiveMesh::move_vertex(std::int32_t vertex, const survey::LatticePoint& to) {
  const auto found = vertices_.find(vertex);
  if (found == vertices_.end()) return false;
  found->second = to;
  return true;
}

bool NaiveMesh::split_edge(std::int32_t a, std::int32_t b, const survey::LatticePoint& at) {
  const auto forward = face_running(a, b), backward = face_running(b, a);
  if (!forward && !backward) return false;
  const std::int32_t m = next_vertex_++;
  vertices_[m] = at;
  for (const auto& face : {forward, backward}) {
    if (!face) continue;
    Corners& kept = faces_[*face];
    Corners half = kept;
    std::replace(kept.begin(), kept.end(), b, m);
    std::replace(half.begin(), half.end(), a, m);
    faces_[next_face_++] = half;
  }
  return true;
}

std::size_t NaiveMesh::edge_count() const {
  std::set<std::array<std::int32_t, 2>> edges;
  for (const auto& [id, face] : faces_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = face[k], b = face[(k + 1) % 3];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  }
  return edges.size();
}

}  // namespace footwall::verify
