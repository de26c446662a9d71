#include "engine/isosurface/measure.h"

#include <cmath>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

using survey::Vector3;

// Six times a volume is summed in multiples of 2^-35 of a voxel: a triangle within one cell has at most twice
// a voxel's face, at most 2^25 from the origin, so that a multiple has fewer than 62 bits.
constexpr double kVolumeQuantum = 0x1p-35;
// The same for areas, which are at most half the square of the cell's longest way.
constexpr int kAreaBits = 60;

Vector3 vector_of(const Point& from, const Point& to) {
  return {static_cast<double>(to.i) - from.i, static_cast<double>(to.j) - from.j,
          static_cast<double>(to.k) - from.k};
}

}  // namespace

Int128 ExactSum::value() const {
  return (static_cast<Int128>(static_cast<std::int64_t>(high)) << 64) | low;
}

void ExactSum::add(Int128 quanta) {
  const Int128 sum = value() + quanta;
  low = static_cast<std::uint64_t>(sum);
  high = static_cast<std::uint64_t>(sum >> 64);
}

Measure::Measure(const std::array<Vector3, 3>& steps) : steps_(steps) {
  cell_volume_ = std::abs(dot(steps[0], cross(steps[1], steps[2])));
  double longest = 0;
  for (const Vector3& step : steps) longest += length(step);
  if (!std::isfinite(longest) || !std::isfinite(cell_volume_) || !(cell_volume_ > 0)) {
    throw Error(ErrorCode::kInvalid, "the steps of the grid are no measure of space: a cell has no volume");
  }
  area_quantum_ = std::ldexp(1.0, std::ilogb(longest * longest) + 1 - kAreaBits);
}

Measure Measure::of_spacing(double inline_step, double crossline_step, double sample_step) {
  return Measure({{{inline_step, 0, 0}, {0, crossline_step, 0}, {0, 0, sample_step}}});
}

std::int64_t Measure::area(const Point& a, const Point& b, const Point& c) const {
  const auto in_world = [&](const Vector3& v) { return steps_[0] * v.x + steps_[1] * v.y + steps_[2] * v.z; };
  const Vector3 normal = cross(in_world(vector_of(a, b)), in_world(vector_of(a, c)));
  return static_cast<std::int64_t>(std::nearbyint(length(normal) / 2 / area_quantum_));
}

std::int64_t Measure::volume(const Point& a, const Point& b, const Point& c) {
  const Vector3 base{a.i, a.j, a.k};
  const double six = dot(base, cross(vector_of(a, b), vector_of(a, c)));
  return static_cast<std::int64_t>(std::nearbyint(six / kVolumeQuantum));
}

double Measure::area_of(const ExactSum& sum) const {
  return static_cast<double>(sum.value()) * area_quantum_;
}

double Measure::volume_of(const ExactSum& sum) const {
  return static_cast<double>(sum.value()) * kVolumeQuantum / 6 * cell_volume_;
}

}  // namespace footwall::isosurface
