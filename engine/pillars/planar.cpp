#include "engine/pillars/planar.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct VertexInfo {
  std::int32_t point = -1;
  double height = 0;
};
struct FaceInfo {
  std::int32_t region = -1;  // 0 and up: a region or, while filling, inside; -1 outside
  bool pending = false;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;
using Point = Triangulation::Point;
using VertexHandle = Triangulation::Vertex_handle;
using FaceHandle = Triangulation::Face_handle;

[[noreturn]] void too_close() {
  throw Error(ErrorCode::kInvalid,
              "pillars or the edges between their ends come too close to tell their order",
              "move the nodes where pillars nearly touch");
}

// The vertices of the points with these numbers, in that order. They are inserted in a biased random order
// along a space filling curve (Amenta, Choi and Rote, incremental constructions con BRIO, 2003): one by one
// along a pillar, each would flip edges to all before it.
std::vector<VertexHandle> insert_all(Triangulation& t, std::span<const ChartPoint> points,
                                     std::span<const std::int32_t> numbers, const JobContext& job) {
  std::vector<Point> places;
  for (std::int32_t p : numbers) places.emplace_back(points[p].strike, points[p].dip);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  using PlaceOf = CGAL::Pointer_property_map<Point>::type;
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_2<Kernel, PlaceOf>(CGAL::make_property_map(places)));
  std::vector<VertexHandle> handles(places.size());
  FaceHandle hint;
  for (std::size_t n : order) {
    job.check();
    const VertexHandle v = t.insert(places[n], hint);
    if (v->info().point >= 0) too_close();  // it was there before
    v->info() = {numbers[n], points[numbers[n]].height};
    handles[n] = v;
    hint = v->face();
  }
  return handles;
}

void constrain(Triangulation& t, VertexHandle a, VertexHandle b) {
  try {
    t.insert_constraint(a, b);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    too_close();
  }
  if (!t.is_edge(a, b)) too_close();  // it runs through another point and was split there
}

// Gives the number to every face reached from `start` without crossing a constraint.
template <typename Outside>
void flood(Triangulation& t, FaceHandle start, std::int32_t number, const Outside& fresh) {
  std::vector<FaceHandle> queue{start};
  start->info().region = number;
  while (!queue.empty()) {
    const FaceHandle f = queue.back();
    queue.pop_back();
    for (int k = 0; k < 3; ++k) {
      const FaceHandle next = f->neighbor(k);
      if (f->is_constrained(k) || t.is_infinite(next) || !fresh(next)) continue;
      next->info().region = number;
      queue.push_back(next);
    }
  }
}

double length2_between(VertexHandle a, VertexHandle b) {
  const double x = a->point().x() - b->point().x(), y = a->point().y() - b->point().y();
  const double z = a->info().height - b->info().height;
  return x * x + y * y + z * z;
}

struct Candidate {
  double urgency = 0;  // <= 0: nothing to do
  double strike = 0, dip = 0, height = 0;
  FaceHandle face;
  std::array<VertexHandle, 3> vertices;
};

class Filler {
 public:
  Filler(Triangulation& t, Reference* reference, const FillOptions& options)
      : t_(t), reference_(reference), options_(options) {}

  Candidate examine(FaceHandle f) const {
    Candidate best;
    best.face = f;
    for (int k = 0; k < 3; ++k) best.vertices[static_cast<std::size_t>(k)] = f->vertex(k);
    // 1. The longest edge that may be split.
    double longest2 = 0, longest_flat2 = 0;
    int edge = -1;
    for (int k = 0; k < 3; ++k) {
      const VertexHandle a = f->vertex(Triangulation::ccw(k)), b = f->vertex(Triangulation::cw(k));
      const double flat2 = CGAL::squared_distance(a->point(), b->point());
      longest_flat2 = std::max(longest_flat2, flat2);
      if (f->is_constrained(k)) continue;
      const double length2 = length2_between(a, b);
      if (length2 > longest2) longest2 = length2, edge = k;
    }
    if (longest2 > options_.max_edge * options_.max_edge) {
      const VertexHandle a = f->vertex(Triangulation::ccw(edge)), b = f->vertex(Triangulation::cw(edge));
      best.urgency = 1e9 + longest2;
      best.strike = 0.5 * (a->point().x() + b->point().x());
      best.dip = 0.5 * (a->point().y() + b->point().y());
      best.height = reference_ ? reference_->height(best.strike, best.dip)
                               : 0.5 * (a->info().height + b->info().height);
      return best;
    }
    // 2. The largest height error on a grid of about 1.25 voxels; the margin covers what lies between its
    // points.
    if (!reference_ || longest_flat2 < 1.0 / 64) return best;
    const int steps = std::clamp(static_cast<int>(std::ceil(std::sqrt(longest_flat2) / 1.25)), 2, 24);
    double worst = 0.85 * options_.detail;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const int k = steps - i - j;
        if (i == steps || j == steps || k == steps || on_constraint(f, i, j, k)) continue;
        const double a = double(i) / steps, b = double(j) / steps, c = double(k) / steps;
        const auto &p = f->vertex(0), &q = f->vertex(1), &r = f->vertex(2);
        const double x = a * p->point().x() + b * q->point().x() + c * r->point().x();
        const double y = a * p->point().y() + b * q->point().y() + c * r->point().y();
        const double flat = a * p->info().height + b * q->info().height + c * r->info().height;
        const double height = reference_->height(x, y);
        const double error = std::abs(height - flat);
        if (error <= worst) continue;
        worst = error;
        best.urgency = error;
        best.strike = x, best.dip = y, best.height = height;
      }
    }
    return best;
  }

  // Inserts the candidate's point unless its face has gone or the point lies on the rim; appends the new
  // faces.
  void insert(const Candidate& c, std::int32_t number, std::vector<FaceHandle>& pending) const {
    FaceHandle f;
    if (!t_.is_face(c.vertices[0], c.vertices[1], c.vertices[2], f))
      return;  // its pieces are pending already
    int index = 0;
    Triangulation::Locate_type type;
    const Point p(c.strike, c.dip);
    const FaceHandle at = t_.locate(p, type, index, f);
    if (t_.is_infinite(at) || at->info().region < 0) return;
    if (type != Triangulation::FACE && type != Triangulation::EDGE) return;
    if (type == Triangulation::EDGE && at->is_constrained(index)) return;
    const VertexHandle v = t_.insert(p, type, at, index);
    v->info() = {number, c.height};
    auto around = t_.incident_faces(v);
    const auto end = around;
    do {
      around->info() = {0, true};
      pending.push_back(around);
    } while (++around != end);
  }

 private:
  static bool on_constraint(FaceHandle f, int i, int j, int k) {
    return (i == 0 && f->is_constrained(0)) || (j == 0 && f->is_constrained(1)) ||
           (k == 0 && f->is_constrained(2));
  }

  Triangulation& t_;
  Reference* reference_;
  FillOptions options_;
};

void sort_unique(std::vector<std::int32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::vector<std::int32_t> points_of(const Region& region) {
  std::vector<std::int32_t> used = region.points;
  for (const auto* edges : {&region.rim, &region.inner})
    for (const PointEdge& e : *edges) used.insert(used.end(), e.begin(), e.end());
  sort_unique(used);
  return used;
}

}  // namespace

std::vector<Region> regions_of(std::span<const ChartPoint> points, std::span<const PointEdge> edges,
                               std::span<const std::int32_t> lone, const JobContext& job) {
  Triangulation t;
  std::vector<std::int32_t> used(lone.begin(), lone.end());
  for (const PointEdge& e : edges) used.insert(used.end(), e.begin(), e.end());
  sort_unique(used);
  const std::vector<VertexHandle> inserted = insert_all(t, points, used, job);
  std::vector<VertexHandle> handles(points.size());
  for (std::size_t n = 0; n < used.size(); ++n) handles[used[n]] = inserted[n];
  for (const PointEdge& e : edges) {
    job.check();
    constrain(t, handles[e[0]], handles[e[1]]);
  }
  if (t.dimension() < 2) return {};

  // 1. What is reached from outside is outside; the rest falls into regions.
  std::int32_t count = 0;
  for (FaceHandle f : t.all_face_handles()) f->info().region = -2;
  std::vector<FaceHandle> outside;
  for (FaceHandle f : t.all_face_handles()) {
    if (!t.is_infinite(f)) continue;
    const int k = f->index(t.infinite_vertex());
    if (!f->is_constrained(k) && f->neighbor(k)->info().region == -2)
      flood(t, f->neighbor(k), -1, [](FaceHandle g) { return g->info().region == -2; });
  }
  for (FaceHandle f : t.finite_face_handles())
    if (f->info().region == -2) flood(t, f, count++, [](FaceHandle g) { return g->info().region == -2; });

  // 2. Their rims.
  std::vector<Region> regions(static_cast<std::size_t>(count));
  for (FaceHandle f : t.finite_face_handles()) {
    const std::int32_t here = f->info().region;
    if (here < 0) continue;
    for (int k = 0; k < 3; ++k) {
      if (!f->is_constrained(k)) continue;
      const std::int32_t a = f->vertex(Triangulation::ccw(k))->info().point;
      const std::int32_t b = f->vertex(Triangulation::cw(k))->info().point;
      const FaceHandle other = f->neighbor(k);
      const bool same = !t.is_infinite(other) && other->info().region == here;
      if (!same) regions[here].rim.push_back({a, b});
      if (same && a < b) regions[here].inner.push_back({a, b});
    }
  }
  for (std::int32_t p : lone) {
    const FaceHandle f = handles[p]->face();
    if (!t.is_infinite(f) && f->info().region >= 0) regions[f->info().region].points.push_back(p);
  }
  for (Region& r : regions) {
    std::sort(r.rim.begin(), r.rim.end());
    std::sort(r.inner.begin(), r.inner.end());
    std::sort(r.points.begin(), r.points.end());
  }
  std::sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) { return a.rim < b.rim; });
  return regions;
}

Error too_many_vertices() {
  return {ErrorCode::kMemory, "the fault would need more than 5 million vertices",
          "ask for a larger --detail or --max-edge"};
}

double least_points(const Region& region, std::span<const ChartPoint> points, double max_edge) {
  double twice_area = 0;
  for (const PointEdge& e : region.rim) {
    const ChartPoint &a = points[e[0]], &b = points[e[1]];
    twice_area += a.strike * b.dip - b.strike * a.dip;
  }
  // Two edges within the limit bound an area of half its square; triangles are twice the vertices inside, and
  // the rim's.
  const double least = 0.5 * std::abs(twice_area) / (max_edge * max_edge);
  return std::max(least - static_cast<double>(region.rim.size()), 0.0);
}

Filling fill_region(const Region& region, std::span<const ChartPoint> points, Reference* reference,
                    const FillOptions& options, const JobContext& job) {
  Triangulation t;
  const std::vector<std::int32_t> used = points_of(region);
  const std::vector<VertexHandle> handles = insert_all(t, points, used, job);
  auto handle = [&](std::int32_t p) {
    return handles[static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), p) - used.begin())];
  };
  for (const auto* edges : {&region.rim, &region.inner})
    for (const PointEdge& e : *edges) {
      job.check();
      constrain(t, handle(e[0]), handle(e[1]));
    }

  // 1. Inside is what lies to the left of the rim.
  std::vector<FaceHandle> pending;
  for (const PointEdge& e : region.rim) {
    FaceHandle f;
    int k = 0;
    if (!t.is_edge(handle(e[0]), handle(e[1]), f, k)) too_close();
    if (f->vertex(Triangulation::ccw(k)) != handle(e[0])) f = f->neighbor(k);
    if (t.is_infinite(f)) too_close();
    if (f->info().region < 0) flood(t, f, 0, [](FaceHandle g) { return g->info().region < 0; });
  }
  for (FaceHandle f : t.finite_face_handles()) {
    if (f->info().region < 0) continue;
    f->info().pending = true;
    pending.push_back(f);
  }
  // 2. Refine in rounds: all pending faces are examined, then the worst are mended first. A face whose
  // neighbour
  //    was mended is usually gone or pending again.
  const Filler filler(t, reference, options);
  const std::int32_t first_added = static_cast<std::int32_t>(points.size());
  std::vector<Candidate> candidates;
  while (!pending.empty()) {
    candidates.clear();
    for (std::size_t n = 0; n < pending.size(); ++n) {
      job.check();
      const FaceHandle f = pending[n];
      if (!f->info().pending) continue;
      f->info().pending = false;
      Candidate c = filler.examine(f);
      if (c.urgency > 0) candidates.push_back(c);
    }
    pending.clear();
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return std::tie(b.urgency, a.strike, a.dip) < std::tie(a.urgency, b.strike, b.dip);
    });
    for (std::size_t n = 0; n < candidates.size(); ++n) {
      job.check();
      const Candidate& c = candidates[n];
      const std::size_t added = t.number_of_vertices() - used.size();
      if (added >= options.most_points) throw too_many_vertices();
      filler.insert(c, first_added + static_cast<std::int32_t>(added), pending);
    }
  }
  // 3. Hand the triangles out in an order of their own.
  Filling filling;
  filling.added.resize(t.number_of_vertices() - used.size());
  for (VertexHandle v : t.finite_vertex_handles())
    if (v->info().point >= first_added)
      filling.added[v->info().point - first_added] = {v->point().x(), v->point().y(), v->info().height};
  for (FaceHandle f : t.finite_face_handles()) {
    if (f->info().region < 0) continue;
    std::array<std::int32_t, 3> face;
    for (int k = 0; k < 3; ++k) face[static_cast<std::size_t>(k)] = f->vertex(k)->info().point;
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    filling.faces.push_back(face);
  }
  std::sort(filling.faces.begin(), filling.faces.end());
  return filling;
}

}  // namespace footwall::pillars
