#include "ui/model/stroke.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

using survey::IndexPoint;

double distance(const IndexPoint& a, const IndexPoint& b) {
  return std::hypot(a.i - b.i, a.j - b.j, a.k - b.k);
}

double distance_to_segment(const IndexPoint& p, const IndexPoint& a, const IndexPoint& b) {
  const double di = b.i - a.i;
  const double dj = b.j - a.j;
  const double dk = b.k - a.k;
  const double square = di * di + dj * dj + dk * dk;
  if (square == 0) return distance(p, a);
  const double part = std::clamp(((p.i - a.i) * di + (p.j - a.j) * dj + (p.k - a.k) * dk) / square, 0.0, 1.0);
  return distance(p, {a.i + part * di, a.j + part * dj, a.k + part * dk});
}

}  // namespace

std::vector<IndexPoint> simplified(std::span<const IndexPoint> stroke, double tolerance) {
  std::vector<IndexPoint> points;
  for (const IndexPoint& p : stroke) {
    if (points.empty() || !(p == points.back())) points.push_back(p);
  }
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t farthest = from;
    double far = tolerance;
    for (std::size_t n = from + 1; n < to; ++n) {
      const double d = distance_to_segment(points[n], points[from], points[to]);
      if (d > far) {
        far = d;
        farthest = n;
      }
    }
    if (farthest == from) continue;
    kept[farthest] = true;
    open.emplace_back(from, farthest);
    open.emplace_back(farthest, to);
  }
  std::vector<IndexPoint> nodes;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (kept[n]) nodes.push_back(points[n]);
  }
  return nodes;
}

std::size_t best_place(std::span<const IndexPoint> line, const IndexPoint& point) {
  if (line.empty()) return 0;
  std::size_t best = line.size();
  double least = distance(line.back(), point);
  const auto consider = [&](std::size_t place, double longer) {
    if (longer >= least) return;
    least = longer;
    best = place;
  };
  if (line.size() > 1) consider(0, distance(line.front(), point));
  for (std::size_t n = 1; n < line.size(); ++n) {
    consider(n, distance(line[n - 1], point) + distance(point, line[n]) - distance(line[n - 1], line[n]));
  }
  return best;
}

}  // namespace footwall::ui
