#include "unit/pillars/intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <map>

namespace footwall::pillars::testing {

bool cuts_itself(const FaultMesh& mesh, bool on_lattice) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  namespace pmp = CGAL::Polygon_mesh_processing;
  auto coordinate = [&](double x) { return on_lattice ? std::nearbyint(x * 256) / 256 : x; };
  std::vector<Kernel::Point_3> points;
  std::map<std::array<double, 3>, std::size_t> number;
  std::vector<std::size_t> point_of;
  for (const MeshVertex& v : mesh.vertices) {
    const std::array<double, 3> p{coordinate(v.position.i), coordinate(v.position.j),
                                  coordinate(v.position.k)};
    const auto [at, fresh] = number.emplace(p, points.size());
    if (fresh) points.emplace_back(p[0], p[1], p[2]);
    point_of.push_back(at->second);
  }
  std::vector<std::array<std::size_t, 3>> faces;
  for (const MeshFace& f : mesh.faces) {
    const std::array<std::size_t, 3> t{point_of[f.vertices[0]], point_of[f.vertices[1]],
                                       point_of[f.vertices[2]]};
    if (on_lattice && CGAL::collinear(points[t[0]], points[t[1]], points[t[2]])) continue;
    faces.push_back(t);
  }
  if (!pmp::is_polygon_soup_a_polygon_mesh(faces)) return true;
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  pmp::polygon_soup_to_polygon_mesh(points, faces, surface);
  return pmp::does_self_intersect(surface);
}

}  // namespace footwall::pillars::testing
