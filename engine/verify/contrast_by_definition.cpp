#include "engine/verify/contrast_by_definition.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "engine/verify/voxel_oracle.h"

namespace footwall::verify {
namespace {

using Wide = std::array<long double, 3>;

Wide normal_of(const survey::LatticeTriangle& t) {
  const auto edge = [&](std::size_t n) -> Wide {
    return {static_cast<long double>(t[n].i) - t[0].i, static_cast<long double>(t[n].j) - t[0].j,
            static_cast<long double>(t[n].k) - t[0].k};
  };
  const Wide a = edge(1);
  const Wide b = edge(2);
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

std::vector<survey::Index> voxels_in_survey(const survey::LatticeTriangle& triangle,
                                            const survey::Index& dims) {
  survey::Box box{{0, 0, 0}, dims};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::int64_t most = std::numeric_limits<std::int64_t>::min();
    for (const survey::LatticePoint& p : triangle) {
      const std::int64_t at = axis == 0 ? p.i : axis == 1 ? p.j : p.k;
      least = std::min(least, at);
      most = std::max(most, at);
    }
    box.lo[axis] = std::max<std::int64_t>(0, least / 256 - 2);
    box.hi[axis] = std::min(dims[axis], most / 256 + 3);
  }
  if (box.empty()) return {};
  return voxels_by_definition(triangle, box);
}

ContrastByDefinition contrast_by_definition(const survey::LatticeTriangle& triangle,
                                            const survey::Index& dims, const ValueAt& value, double max_abs,
                                            int side) {
  ContrastByDefinition result;
  const Wide normal = normal_of(triangle);
  const long double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  if (length == 0) return result;
  std::map<int, double> at;  // by shift along the winding's normal; without the null ones
  double own = extract::kUndefined;
  for (int shift = -8; shift <= 8; ++shift) {
    survey::LatticeTriangle moved = triangle;
    for (survey::LatticePoint& p : moved) {
      p.i += static_cast<std::int32_t>(std::nearbyint(256 * shift * normal[0] / length));
      p.j += static_cast<std::int32_t>(std::nearbyint(256 * shift * normal[1] / length));
      p.k += static_cast<std::int32_t>(std::nearbyint(256 * shift * normal[2] / length));
    }
    const extract::FaceStatistics there = statistics_by_definition(voxels_in_survey(moved, dims), dims, value,
                                                                   max_abs, extract::Outside::kInside);
    if (shift == 0) own = there.discontinuity;
    if (there.count >= 30 && !std::isnan(there.discontinuity)) at[shift] = there.discontinuity;
  }
  if (at.contains(-6) && at.contains(6)) result.contrast = own - (at[-6] + at[6]) / 2;
  double highest = -1;
  for (const auto& [shift, value_there] : at) highest = std::max(highest, value_there);
  for (const int shift : {0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6, -6, 7, -7, 8, -8}) {
    if (!at.contains(shift) || at[shift] != highest) continue;
    result.offset_voxels = shift == 0 ? 0 : side * shift;
    result.offset_score = highest;
    break;
  }
  return result;
}

int side_by_definition(std::span<const extract::Face> faces) {
  Wide sum{0, 0, 0};
  for (const extract::Face& face : faces) {
    const Wide normal = normal_of(face.triangle);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += normal[axis];
  }
  for (const long double component : sum) {
    if (component != 0) return component > 0 ? 1 : -1;
  }
  return 1;
}

float attribute_by_definition(const survey::Index& voxel, const survey::Index& window,
                              const survey::Index& dims, const ValueAt& value, double max_abs) {
  using Integer = boost::multiprecision::cpp_int;
  const survey::Box survey_box{{0, 0, 0}, dims};
  const std::int64_t traces = window[0] * window[1];
  const double most = static_cast<double>(traces * traces) * (max_abs * max_abs);
  Integer all_num = 0;
  Integer all_den = 0;
  for (std::int64_t dk = -(window[2] / 2); dk <= window[2] / 2; ++dk) {
    double sum = 0;
    double squares = 0;
    std::int64_t m = 0;
    for (std::int64_t di = -(window[0] / 2); di <= window[0] / 2; ++di) {
      for (std::int64_t dj = -(window[1] / 2); dj <= window[1] / 2; ++dj) {
        const survey::Index p{voxel[0] + di, voxel[1] + dj, voxel[2] + dk};
        if (!survey_box.contains(p)) continue;
        const double v = value(p);
        if (!std::isfinite(v)) continue;
        sum += v;
        squares += v * v;
        ++m;
      }
    }
    if (m < std::min<std::int64_t>(4, traces) || max_abs == 0) continue;
    const double unit = std::ldexp(1.0, 40) / most;
    all_num += Integer(std::nearbyint(sum * sum * unit));
    all_den += Integer(std::nearbyint(static_cast<double>(m) * squares * unit));
  }
  if (all_den == 0) return std::numeric_limits<float>::quiet_NaN();
  const Integer difference = all_num > all_den ? Integer(0) : Integer(all_den - all_num);
  return static_cast<float>(static_cast<double>(difference) / static_cast<double>(all_den));
}

}  // namespace footwall::verify
