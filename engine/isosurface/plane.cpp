#include "engine/isosurface/plane.h"

#include <cmath>
#include <vector>

#include "engine/isosurface/detail/half_table.h"
#include "engine/isosurface/detail/sweep.h"

namespace footwall::isosurface {
namespace {

// What is kept of two planes of samples. The paper's X, Y and Z are our samples, crosslines and inlines.
class TwoPlanes {
 public:
  TwoPlanes(const detail::Draft& draft, const detail::PlaneShape& shape) : draft_(draft), shape_(shape) {
    for (Plane& plane : planes_) {
      plane.inside.resize(shape.room());
      plane.faces.resize(shape.room());
      if (!draft.normals) continue;
      plane.gradients.resize(shape.room());
      plane.has_gradient.resize(shape.room());
    }
  }

  // The signs of the samples, and from them the face index of each square of four: bit l + 2m for the sample
  // l crosslines and m samples further.
  void look_at(std::int64_t i) {
    Plane& plane = planes_[i & 1];
    if (draft_.normals) plane.has_gradient.assign(plane.has_gradient.size(), 0);
    const float isovalue = draft_.isovalue;
    const std::int64_t columns = shape_.columns;
    for (std::int64_t j = draft_.samples.lo[1]; j < draft_.samples.hi[1]; ++j) {
      const float* const row = draft_.at(i, j, shape_.first_k);
      std::uint8_t* const inside = plane.inside.data() + shape_.at(j, shape_.first_k);
      for (std::int64_t n = 0; n < columns; ++n) {
        inside[n] = static_cast<std::uint8_t>((row[n] >= isovalue ? 1 : 0) | (row[n] == row[n] ? 0 : kNull));
      }
    }
    int nulls = 0;
    for (std::int64_t j = draft_.cells.lo[1]; j < draft_.cells.hi[1]; ++j) {
      const std::size_t p = shape_.at(j, shape_.first_k);
      const std::uint8_t *const here = plane.inside.data() + p, *const next = here + shape_.stride;
      std::uint8_t* const faces = plane.faces.data() + p;
      for (std::int64_t n = 0; n + 1 < columns; ++n) {
        const int face = (here[n] & 1) | (next[n] & 1) << 1 | (here[n + 1] & 1) << 2 | (next[n + 1] & 1) << 3;
        const int null = (here[n] | next[n] | here[n + 1] | next[n + 1]) & kNull;
        faces[n] = static_cast<std::uint8_t>(face | null);
        nulls |= null;
      }
    }
    plane.has_nulls = nulls != 0;
  }

  bool classify(std::int64_t i, std::uint8_t* signs, std::uint8_t* nulls) const {
    const Plane &lower = planes_[i & 1], &upper = planes_[(i + 1) & 1];
    const std::int64_t columns = shape_.columns;
    for (std::int64_t j = draft_.cells.lo[1]; j < draft_.cells.hi[1]; ++j) {
      const std::size_t first = shape_.at(j, shape_.first_k);
      const std::uint8_t *const low = lower.faces.data() + first, *const high = upper.faces.data() + first;
      for (std::int64_t n = 0; n + 1 < columns; ++n) {
        nulls[first + n] = static_cast<std::uint8_t>((low[n] | high[n]) & kNull);
        signs[first + n] = static_cast<std::uint8_t>(spread(low[n]) | spread(high[n]) << 1);
      }
    }
    return lower.has_nulls || upper.has_nulls;
  }

  void intersect(std::int64_t i, const std::array<std::uint8_t*, 3>& crossing) const {
    const std::int64_t columns = shape_.columns;
    for (std::int64_t j = draft_.samples.lo[1]; j < draft_.samples.hi[1]; ++j) {
      const std::size_t first = shape_.at(j, shape_.first_k);
      const std::uint8_t* const here = planes_[i & 1].inside.data() + first;
      const std::uint8_t* const above = planes_[(i + 1) & 1].inside.data() + first;
      const std::uint8_t* const beside = here + shape_.stride;
      std::uint8_t *const to_above = crossing[0] + first, *const to_beside = crossing[1] + first,
                          *const to_next = crossing[2] + first;
      for (std::int64_t n = 0; n < columns; ++n) {
        to_above[n] = differ(here[n], above[n]);
        to_beside[n] = differ(here[n], beside[n]);
        to_next[n] = differ(here[n], here[n + 1]);
      }
    }
  }

  float t(int axis, std::int64_t i, std::int64_t j, std::int64_t k) const {
    const float* const value = draft_.at(i, j, k);
    return detail::crossing(value[0], value[draft_.step(axis)], draft_.isovalue);
  }

  // Calculated only where an intersection is near, and once.
  Point gradient(std::int64_t i, std::int64_t j, std::int64_t k) {
    Plane& plane = planes_[i & 1];
    const std::size_t p = shape_.at(j, k);
    if (plane.has_gradient[p] == 0) {
      plane.gradients[p] = draft_.gradient_at(i, j, k);
      plane.has_gradient[p] = 1;
    }
    return plane.gradients[p];
  }

 private:
  static constexpr std::uint8_t kNull = 64;
  // Bit n to bit 2n: the corners of a face among those of the cell.
  static unsigned spread(std::uint8_t face) {
    return (face & 1U) | (face & 2U) << 1 | (face & 4U) << 2 | (face & 8U) << 3;
  }
  static std::uint8_t differ(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((a ^ b) == 1 ? 1 : 0);  // a null is neither inside nor outside
  }

  struct Plane {
    std::vector<std::uint8_t> inside, faces;
    std::vector<Point> gradients;
    std::vector<std::uint8_t> has_gradient;
    bool has_nulls = false;
  };
  const detail::Draft& draft_;
  const detail::PlaneShape& shape_;
  std::array<Plane, 2> planes_;  // [i & 1]
};

}  // namespace

void extract_plane(const Field& field, float isovalue, const ExtractOptions& options, const CaseRules& rules,
                   Surface& into) {
  detail::Draft draft(field, isovalue, options, "plane");
  const detail::PatternTable table(rules);
  detail::Sweep<TwoPlanes, detail::PatternTable>(draft, table).run();
  draft.hand_over(into);
}

void extract_plane(const Field& field, float isovalue, const ExtractOptions& options, Surface& into) {
  extract_plane(field, isovalue, options, trilinear_rules(), into);
}

}  // namespace footwall::isosurface
