// Grows meshes of triangles of a given mean area inside a survey, and picks where their vertices move.
// Based on: what seed 004, appendix B.1.1 tells of its genscript; the shapes are ours: a triangle at a time
// is added to a random border edge, as high as its area asks, and bent more the harder it is to stay inside.
#pragma once
#include <vector>

#include "engine/mesh/model.h"
#include "engine/tasks/workload/random.h"
#include "storage/survey/box.h"
#include "storage/survey/lattice.h"
#include "storage/survey/vector.h"

namespace footwall::tasks {

using Vector = survey::Vector3;  // in index space, in voxels

inline Vector at(const survey::IndexPoint& p) {
  return {p.i, p.j, p.k};
}

class Grower {
 public:
  // area > 0 and distance >= 0 in voxels; throws Error kInvalid where they would leave the lattice.
  Grower(const survey::Index& size, double area, double distance, std::uint64_t seed);

  // CREATE-MESH and `faces` ADD-FACEs, applied to `meshes` and appended to `operations`. Vertices keep inside
  // the survey where a few tries find such a place, else as near as was found.
  mesh::MeshId grow(std::int64_t faces, mesh::MeshSet& meshes, std::vector<mesh::Operation>& operations);
  // Where a vertex goes: in a random direction by a random length of mean `distance`, inside the survey if a
  // few directions lead there.
  mesh::LatticePoint moved(const survey::IndexPoint& from);
  Random& random() { return random_; }

 private:
  struct Hinge {  // a border edge and its face's third vertex
    Vector a, b, opposite;
  };
  double next_area();
  double beyond(const Vector& p) const;
  std::array<Vector, 3> first_triangle(double area);
  Vector apex(const Hinge& hinge, double area, double bend);
  static Hinge hinge_of(const mesh::Mesh& mesh, mesh::EdgeId edge);

  Vector low_, high_;  // the survey's box
  double area_, distance_;
  double owed_ = 0;  // by the last triangle to the next, so that the mean is met
  bool owes_ = false;
  Random random_;
  survey::Lattice lattice_;
};

// In voxel^2.
double area_of(const survey::LatticeTriangle& triangle);

}  // namespace footwall::tasks
