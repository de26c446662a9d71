#include "engine/tasks/workload/grow.h"

#include <algorithm>
#include <limits>

namespace footwall::tasks {
namespace {

using mesh::LatticePoint;
using survey::IndexPoint;

constexpr double kSpread = 0.2;  // areas lie within so much of the mean
constexpr int kFirstTries = 32;  // places and directions of a mesh's first triangle
constexpr int kEdges = 4;        // border edges tried for each bend
constexpr int kMoveTries = 8;    // directions of a move
constexpr double kSqrt3 = 1.7320508075688772;
// Tangents of half the largest angle between a face and its neighbour's plane, tried one after another: 23,
// 44, 77, 143 degrees, then back along the neighbour.
constexpr std::array<double, 5> kBends{0.2, 0.4, 0.8, 3.0, 100.0};

IndexPoint index_point(const Vector& v) {
  return {v.x, v.y, v.z};
}

double outside(double x, double low, double high) {
  return std::max({low - x, x - high, 0.0});
}

}  // namespace

Grower::Grower(const survey::Index& size, double area, double distance, std::uint64_t seed)
    : low_{-0.5, -0.5, -0.5},
      high_{static_cast<double>(size[0]) - 0.5, static_cast<double>(size[1]) - 0.5,
            static_cast<double>(size[2]) - 0.5},
      area_(area),
      distance_(distance),
      random_(seed),
      lattice_(survey::Geometry{}) {}

// Every second triangle makes up for the one before it.
double Grower::next_area() {
  owes_ = !owes_;
  if (owes_) owed_ = random_.between(-kSpread, kSpread);
  return area_ * (1 + (owes_ ? owed_ : -owed_));
}

double Grower::beyond(const Vector& p) const {
  const Vector v{outside(p.x, low_.x, high_.x), outside(p.y, low_.y, high_.y), outside(p.z, low_.z, high_.z)};
  return dot(v, v);
}

std::array<Vector, 3> Grower::first_triangle(double area) {
  const double side = std::sqrt(4 / kSqrt3 * area);
  std::array<Vector, 3> best{};
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kFirstTries && least > 0; ++n) {
    const Vector centre{random_.between(low_.x, high_.x), random_.between(low_.y, high_.y),
                        random_.between(low_.z, high_.z)};
    const Vector u = random_.direction();
    Vector v = cross(u, random_.direction());
    if (length(v) < 0.1) continue;
    v = v * (1 / length(v));
    const std::array<Vector, 3> corners{centre - u * (side / 2) - v * (side / (2 * kSqrt3)),
                                        centre + u * (side / 2) - v * (side / (2 * kSqrt3)),
                                        centre + v * (side / kSqrt3)};
    const double far = beyond(corners[0]) + beyond(corners[1]) + beyond(corners[2]);
    if (far >= least) continue;
    least = far;
    best = corners;
  }
  return best;
}

// Off the hinge's edge, on the far side of its face, turned about the edge.
Vector Grower::apex(const Hinge& hinge, double area, double bend) {
  const Vector edge = hinge.b - hinge.a;
  const double size = std::max(length(edge), 1e-3);
  const Vector along = edge * (1 / size);
  Vector out = hinge.a - hinge.opposite;
  out = out - along * dot(out, along);
  out = length(out) > 1e-6 ? out * (1 / length(out)) : cross(along, random_.direction());
  const double t = random_.between(-bend, bend);  // tan of half the angle
  const double cosine = (1 - t * t) / (1 + t * t), sine = 2 * t / (1 + t * t);
  const Vector up = out * cosine + cross(along, out) * sine;
  return hinge.a + edge * random_.between(0.35, 0.65) + up * (2 * area / size);
}

Grower::Hinge Grower::hinge_of(const mesh::Mesh& mesh, mesh::EdgeId id) {
  const mesh::Edge& edge = mesh.edge(id);
  const mesh::Face& face = mesh.face(edge.faces[0] != mesh::kNone ? edge.faces[0] : edge.faces[1]);
  mesh::VertexId opposite = face.vertices[0];
  for (const mesh::VertexId v : face.vertices) {
    if (v != edge.vertices[0] && v != edge.vertices[1]) opposite = v;
  }
  return {at(mesh.position(edge.vertices[0])), at(mesh.position(edge.vertices[1])),
          at(mesh.position(opposite))};
}

mesh::MeshId Grower::grow(std::int64_t faces, mesh::MeshSet& meshes,
                          std::vector<mesh::Operation>& operations) {
  const auto apply = [&](mesh::Operation operation) {
    const mesh::Applied made = meshes.apply(operation);
    operations.push_back(std::move(operation));
    return made;
  };
  mesh::CreateMesh create{{}, {{0, 1, 2}}};
  for (const Vector& corner : first_triangle(next_area()))
    create.positions.push_back(lattice_.from_index(index_point(corner)));
  const mesh::MeshId id = apply(std::move(create)).mesh;
  const mesh::Mesh& mesh = meshes.mesh(id);
  const mesh::Face first = mesh.face(0);
  std::vector<mesh::EdgeId> border(first.edges.begin(), first.edges.end());
  for (std::int64_t n = 0; n < faces; ++n) {
    const double area = next_area();
    std::size_t chosen = 0;
    Vector place;
    double least = std::numeric_limits<double>::infinity();
    for (const double bend : kBends) {
      for (int attempt = 0; attempt < kEdges && least > 0; ++attempt) {
        const std::size_t edge = random_.below(border.size());
        const Vector found = apex(hinge_of(mesh, border[edge]), area, bend);
        const double far = beyond(found);
        if (far >= least) continue;
        least = far;
        place = found;
        chosen = edge;
      }
    }
    const mesh::Applied made =
        apply(mesh::AddFace{id, border[chosen], lattice_.from_index(index_point(place))});
    const mesh::Face& face = mesh.face(made.face);
    border[chosen] = face.edges[1];
    border.push_back(face.edges[2]);
  }
  return id;
}

LatticePoint Grower::moved(const IndexPoint& from) {
  const double far = random_.between(0, 2 * distance_);
  Vector best = at(from);
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kMoveTries && least > 0; ++n) {
    const Vector to = at(from) + random_.direction() * far;
    if (beyond(to) >= least) continue;
    least = beyond(to);
    best = to;
  }
  return lattice_.from_index(index_point(best));
}

double area_of(const survey::LatticeTriangle& triangle) {
  const auto corner = [&](std::size_t n) { return at(survey::Lattice::index_of(triangle[n])); };
  return length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
}

}  // namespace footwall::tasks
