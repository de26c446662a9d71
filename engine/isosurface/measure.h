// Areas and volumes of surfaces in the survey's measure, summed without rounding: each triangle's
// contribution is computed in double and rounded to a multiple of a fixed power of two, and the multiples are
// added as integers. Sums are therefore the same, bit for bit, in any order and for any partition.
#pragma once
#include <array>
#include <compare>
#include <cstdint>

#include "engine/isosurface/surface.h"
#include "storage/survey/vector.h"

namespace footwall::isosurface {

__extension__ typedef __int128 Int128;

// A count of quanta as two words, the form in which it is sent between ranks.
struct ExactSum {
  std::uint64_t low = 0;
  std::uint64_t high = 0;  // two's complement

  Int128 value() const;
  void add(Int128 quanta);
  void merge(const ExactSum& other) { add(other.value()); }
  friend bool operator==(const ExactSum&, const ExactSum&) = default;
};

class Measure {
 public:
  // What one step of the index along inlines, crosslines and samples is in the world, in any unit, the same
  // on all three: the three spacings on the diagonal, or the columns of a map that shears or turns. Throws
  // Error kInvalid for steps that are not finite or lie in a plane.
  explicit Measure(const std::array<survey::Vector3, 3>& steps);
  // In voxels.
  Measure() : Measure(std::array<survey::Vector3, 3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}) {}
  static Measure of_spacing(double inline_step, double crossline_step, double sample_step);

  // Of one triangle, in quanta. A triangle has its vertices within one cell of each other.
  std::int64_t area(const Point& a, const Point& b, const Point& c) const;
  // The signed volume between the triangle and the origin, of which a closed surface's triangles sum up to
  // the volume that it encloses: positive where the values inside are at or above the isovalue.
  static std::int64_t volume(const Point& a, const Point& b, const Point& c);

  // The sums in the steps' unit, squared and cubed.
  double area_of(const ExactSum& sum) const;
  double volume_of(const ExactSum& sum) const;

 private:
  std::array<survey::Vector3, 3> steps_;
  double cell_volume_ = 1;  // > 0 whatever the handedness
  double area_quantum_ = 1;
};

}  // namespace footwall::isosurface
