#include "engine/isosurface/tables/triangulate.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/isosurface/tables/cell.h"

namespace footwall::isosurface::tables {
namespace {

constexpr double kSameArea = 1e-9;  // below, the first one found stays: the order of sums must not decide

using Vector = std::array<double, 3>;

Vector middle(int edge) {
  Vector at{};
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = ((lower_corner(edge) >> axis & 1) + (upper_corner(edge) >> axis & 1)) / 2.0;
  return at;
}

double area(const Vector& a, const Vector& b, const Vector& c) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const double part = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    sum += part * part;
  }
  return std::sqrt(sum) / 2;
}

unsigned vertices_beside_centre(const Triangles& triangles) {
  unsigned beside = 0;
  for (const std::array<int, 3>& triangle : triangles) {
    if (std::find(triangle.begin(), triangle.end(), kCentreVertex) == triangle.end()) continue;
    for (const int vertex : triangle) {
      if (vertex != kCentreVertex) beside |= 1U << vertex;
    }
  }
  return beside;
}

double area(const Triangles& triangles) {
  const unsigned beside = vertices_beside_centre(triangles);
  Vector centre{};
  for (int edge = 0; edge < 12; ++edge) {
    if ((beside >> edge & 1U) == 0) continue;
    for (int axis = 0; axis < 3; ++axis) centre[axis] += middle(edge)[axis] / std::popcount(beside);
  }
  const auto at = [&](int vertex) { return vertex == kCentreVertex ? centre : middle(vertex); };
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += area(at(a), at(b), at(c));
  return sum;
}

struct Means {
  bool chords = false;  // on faces of the cell, those that are its own
  bool centre = false;
};
constexpr std::array<Means, 4> kMeans{{{false, false}, {false, true}, {true, false}, {true, true}}};

bool may_join(int a, int b, bool chords) {
  if (a == b) return false;
  if (a == kCentreVertex || b == kCentreVertex) return true;
  const unsigned common = faces_of(a) & faces_of(b);
  return common == 0 || (chords && may_be_chord(std::countr_zero(common), a, b));
}

// All triangulations of a polygon whose vertices have numbers, some perhaps twice (a ring that was cut), with
// at most one vertex inside; keeps the one of the smallest area.
class Search {
 public:
  explicit Search(const Means& means) : means_(means) {}

  void run(const Loop& polygon) {
    open_ = {polygon};
    done_.clear();
    step(means_.centre);
  }
  const std::optional<Triangles>& best() const { return best_; }

 private:
  // Takes the polygon on top and tries all triangles over its closing edge; leaves open_ as it was.
  void step(bool centre_left) {
    if (open_.empty()) {
      if (!centre_left) judge();
      return;
    }
    const Loop polygon = open_.back();
    open_.pop_back();
    const std::size_t last = polygon.size() - 1;
    for (std::size_t apex = 1; apex < last; ++apex) {
      if (apex > 1 && !may_join(polygon[0], polygon[apex], means_.chords)) continue;
      if (apex + 1 < last && !may_join(polygon[apex], polygon[last], means_.chords)) continue;
      const std::size_t before = open_.size();
      if (apex > 1)
        open_.emplace_back(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(apex) + 1);
      if (apex + 1 < last)
        open_.emplace_back(polygon.begin() + static_cast<std::ptrdiff_t>(apex), polygon.end());
      descend({polygon[0], polygon[apex], polygon[last]}, centre_left);
      open_.resize(before);
    }
    if (centre_left) {
      Loop around = polygon;
      around.push_back(kCentreVertex);
      open_.push_back(around);
      descend({polygon[last], polygon[0], kCentreVertex}, false);
      open_.pop_back();
    }
    open_.push_back(polygon);
  }

  void descend(const std::array<int, 3>& triangle, bool centre_left) {
    // An edge that has two triangles already: this cut of the ring has come back to itself.
    for (int n = 0; n < 3; ++n) {
      for (const std::array<int, 3>& other : done_) {
        for (int m = 0; m < 3; ++m) {
          if (other[m] == triangle[n] && other[(m + 1) % 3] == triangle[(n + 1) % 3]) return;
        }
      }
    }
    done_.push_back(triangle);
    step(centre_left);
    done_.pop_back();
  }

  void judge() {
    const double found = area(done_);
    if (best_ && found > best_area_ - kSameArea) return;
    best_ = done_;
    best_area_ = found;
  }

  Means means_;
  std::vector<Loop> open_;
  Triangles done_;
  std::optional<Triangles> best_;
  double best_area_ = 0;
};

std::optional<Triangles> disc(const Loop& loop, const Means& means) {
  Search search(means);
  search.run(loop);
  return search.best();
}

Loop turned(const Loop& loop, std::size_t first) {
  Loop all(loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
  all.insert(all.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first));
  all.push_back(loop[first]);
  return all;
}

// A ring, cut along one of its edges from loop to loop, is a polygon.
std::optional<Triangles> ring(const Loop& a, const Loop& b, const Means& means) {
  Search search(means);
  for (std::size_t n = 0; n < a.size(); ++n) {
    for (std::size_t m = 0; m < b.size(); ++m) {
      if (!may_join(a[n], b[m], means.chords)) continue;
      Loop polygon = turned(a, n);
      const Loop back = turned(b, m);
      polygon.insert(polygon.end(), back.begin(), back.end());
      search.run(polygon);
    }
  }
  return search.best();
}

}  // namespace

std::optional<Filling> fill(const Contours& contours, const std::optional<Tunnel>& tunnel) {
  Filling filling;
  const auto add = [&](const auto& patch) {
    for (const Means& means : kMeans) {
      if (means.centre && filling.centre_edges != 0) continue;
      const std::optional<Triangles> found = patch(means);
      if (!found) continue;
      if (means.centre) filling.centre_edges = vertices_beside_centre(*found);
      filling.triangles.insert(filling.triangles.end(), found->begin(), found->end());
      return true;
    }
    return false;
  };
  for (std::size_t n = 0; n < contours.loops.size(); ++n) {
    const bool in_tunnel =
        tunnel && (static_cast<int>(n) == tunnel->from || static_cast<int>(n) == tunnel->to);
    if (in_tunnel) continue;
    if (!add([&](const Means& means) { return disc(contours.loops[n], means); })) return std::nullopt;
  }
  if (tunnel && !add([&](const Means& means) {
        return ring(contours.loops[tunnel->from], contours.loops[tunnel->to], means);
      }))
    return std::nullopt;
  return filling;
}

Filling fan(const Contours& contours) {
  Filling filling;
  for (const Loop& loop : contours.loops) {
    for (std::size_t n = 2; n < loop.size(); ++n)
      filling.triangles.push_back({loop[0], loop[n - 1], loop[n]});
  }
  return filling;
}

}  // namespace footwall::isosurface::tables
