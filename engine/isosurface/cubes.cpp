#include "engine/isosurface/cubes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/isosurface/detail/draft.h"

namespace footwall::isosurface {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Cubes {
 public:
  Cubes(detail::Draft& draft, const CaseRules& rules)
      : draft_(draft), rules_(rules), columns_(draft.samples.size(2)) {
    const auto room = static_cast<std::size_t>(draft.samples.size(1) * columns_);
    for (auto& plane : found_) plane.assign(room, {kNone, kNone, kNone});
  }

  void run() {
    const survey::Box& cells = draft_.cells;
    if (cells.empty()) return;
    for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
      auto& next = found_[(i + 1) & 1];
      std::fill(next.begin(), next.end(), Found{kNone, kNone, kNone});
      // Edges to the next plane start here; no cell has had them yet.
      for (Found& found : found_[i & 1]) found[0] = kNone;
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
        draft_.begin_row();
        for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) cube(i, j, k);
      }
    }
  }

 private:
  using Found = std::array<std::uint32_t, 3>;  // vertices on the edges from a sample, by axis

  void cube(std::int64_t i, std::int64_t j, std::int64_t k) {
    std::array<float, 8> values;
    unsigned signs = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const float value = *draft_.at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
      if (std::isnan(value)) return;
      values[corner] = value;
      signs |= (value >= draft_.isovalue ? 1U : 0U) << corner;
    }
    if (signs == 0 || signs == 255) return;
    const Alternative alternative =
        rules_.undecided(signs) ? rules_.decide(signs, values, draft_.isovalue) : Alternative{0};
    const Pattern& pattern = rules_.pattern(signs, alternative);
    std::array<std::uint32_t, kCentre + 1> vertex{};
    std::array<std::uint32_t, kCentre> loop;
    std::size_t count = 0;
    for (int edge = 0; edge < kCentre; ++edge) {
      const int axis = edge / 4, low = edge & 1, high = edge >> 1 & 1;
      const int di = axis == 0 ? 0 : low,
                dj = axis == 0   ? low
                     : axis == 1 ? 0
                                 : high,
                dk = axis == 2 ? 0 : high;
      const int lower = di | dj << 1 | dk << 2, upper = lower | 1 << axis;
      if ((signs >> lower & 1) == (signs >> upper & 1)) continue;
      vertex[edge] = borrow_or_compute(axis, i + di, j + dj, k + dk, values[lower], values[upper]);
      if ((pattern.centre_edges >> edge & 1) != 0) loop[count++] = vertex[edge];
    }
    if (pattern.has_centre) {
      vertex[kCentre] = draft_.reserve_centre(i, j, k);
      draft_.place_centre(vertex[kCentre], std::span(loop).first(count));
    }
    for (const auto& [a, b, c] : pattern.triangles) {
      draft_.triangles.push_back({vertex[a], vertex[b], vertex[c]});
    }
  }

  std::uint32_t borrow_or_compute(int axis, std::int64_t i, std::int64_t j, std::int64_t k, float lower,
                                  float upper) {
    const std::int64_t place = (j - draft_.samples.lo[1]) * columns_ + k - draft_.samples.lo[2];
    std::uint32_t& number = found_[i & 1][static_cast<std::size_t>(place)][axis];
    if (number != kNone) return number;
    const float t = detail::crossing(lower, upper, draft_.isovalue);
    Point normal;
    if (draft_.normals) {
      normal = detail::normal(draft_.gradient_at(i, j, k),
                              draft_.gradient_at(i + (axis == 0), j + (axis == 1), k + (axis == 2)), t, axis,
                              lower >= draft_.isovalue);
    }
    number = draft_.add_vertex(axis, i, j, k, t, normal);
    return number;
  }

  detail::Draft& draft_;
  const CaseRules& rules_;
  const std::int64_t columns_;
  std::array<std::vector<Found>, 2> found_;  // [i & 1]
};

}  // namespace

void extract_cubes(const Field& field, float isovalue, const ExtractOptions& options, const CaseRules& rules,
                   Surface& into) {
  detail::Draft draft(field, isovalue, options, "cubes");
  Cubes(draft, rules).run();
  draft.sort_vertices();
  draft.hand_over(into);
}

void extract_cubes(const Field& field, float isovalue, const ExtractOptions& options, Surface& into) {
  extract_cubes(field, isovalue, options, trilinear_rules(), into);
}

}  // namespace footwall::isosurface
