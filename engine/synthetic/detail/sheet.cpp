#include "engine/synthetic/detail/sheet.h"

#include <map>
#include <utility>

namespace footwall::synthetic::detail {
namespace {

using survey::IndexPoint;
using Corner = std::int32_t;

bool distinct(Corner a, Corner b, Corner c) {
  return a != b && b != c && a != c;
}

// The vertex where an edge crosses value zero, made once per edge.
class Crossings {
 public:
  Crossings(Sheet& sheet, const std::vector<double>& values) : sheet_(sheet), values_(values) {}

  Corner on(Corner a, Corner b) {
    if (a > b) std::swap(a, b);
    const auto [place, fresh] = made_.try_emplace({a, b}, static_cast<Corner>(sheet_.vertices.size()));
    if (fresh) {
      const double t = values_[a] / (values_[a] - values_[b]);
      const IndexPoint p = sheet_.vertices[a];
      const IndexPoint q = sheet_.vertices[b];
      sheet_.vertices.push_back({p.i + (q.i - p.i) * t, p.j + (q.j - p.j) * t, p.k + (q.k - p.k) * t});
    }
    return place->second;
  }

 private:
  Sheet& sheet_;
  const std::vector<double>& values_;
  std::map<std::pair<Corner, Corner>, Corner> made_;
};

// Drops vertices that no triangle uses and joins those at the same place.
Sheet tidied(const Sheet& sheet) {
  Sheet tidy;
  std::map<std::array<double, 3>, Corner> places;
  for (const auto& triangle : sheet.triangles) {
    std::array<Corner, 3> moved{};
    for (int n = 0; n < 3; ++n) {
      const IndexPoint& p = sheet.vertices[triangle[n]];
      const auto [place, fresh] =
          places.try_emplace({p.i, p.j, p.k}, static_cast<Corner>(tidy.vertices.size()));
      if (fresh) tidy.vertices.push_back(p);
      moved[n] = place->second;
    }
    if (distinct(moved[0], moved[1], moved[2])) tidy.triangles.push_back(moved);
  }
  return tidy;
}

}  // namespace

Sheet grid_sheet(int a_cells, int b_cells, const std::function<IndexPoint(int, int)>& at) {
  Sheet sheet;
  for (int a = 0; a <= a_cells; ++a) {
    for (int b = 0; b <= b_cells; ++b) sheet.vertices.push_back(at(a, b));
  }
  for (int a = 0; a < a_cells; ++a) {
    for (int b = 0; b < b_cells; ++b) {
      const Corner here = a * (b_cells + 1) + b;
      const Corner over = here + b_cells + 1;
      sheet.triangles.push_back({here, over, over + 1});
      sheet.triangles.push_back({here, over + 1, here + 1});
    }
  }
  return sheet;
}

Sheet clipped(const Sheet& sheet, const std::function<double(const IndexPoint&)>& value) {
  std::vector<double> values;
  values.reserve(sheet.vertices.size());
  for (const IndexPoint& p : sheet.vertices) values.push_back(value(p));

  Sheet cut;
  cut.vertices = sheet.vertices;
  Crossings crossings(cut, values);
  for (const auto& triangle : sheet.triangles) {
    // Walk the border: keep inner corners, add a vertex wherever an edge changes sides. A corner with value
    // zero is itself the crossing.
    std::array<Corner, 4> border{};
    int corners = 0;
    for (int n = 0; n < 3; ++n) {
      const Corner from = triangle[n];
      const Corner to = triangle[(n + 1) % 3];
      if (values[from] >= 0) border[corners++] = from;
      if ((values[from] > 0 && values[to] < 0) || (values[from] < 0 && values[to] > 0)) {
        border[corners++] = crossings.on(from, to);
      }
    }
    if (corners >= 3) cut.triangles.push_back({border[0], border[1], border[2]});
    if (corners == 4) cut.triangles.push_back({border[0], border[2], border[3]});
  }
  return tidied(cut);
}

Sheet joined(const Sheet& a, const Sheet& b) {
  Sheet both = a;
  const auto offset = static_cast<Corner>(a.vertices.size());
  both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [p, q, r] : b.triangles) both.triangles.push_back({p + offset, q + offset, r + offset});
  return tidied(both);
}

}  // namespace footwall::synthetic::detail
