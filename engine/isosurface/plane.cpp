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
    plane.has_nulls = false;
    if (draft_.normals) plane.has_gradient.assign(plane.has_gradient.size(), 0);
    for (std::int64_t j = draft_.samples.lo[1]; j < draft_.samples.hi[1]; ++j) {
      const float* const row = draft_.at(i, j, 0);
      for (std::int64_t k = draft_.samples.lo[2]; k < draft_.samples.hi[2]; ++k) {
        plane.inside[shape_.at(j, k)] = row[k] >= draft_.isovalue ? 1 : std::isnan(row[k]) ? kNull : 0;
      }
    }
    for (std::int64_t j = draft_.cells.lo[1]; j < draft_.cells.hi[1]; ++j) {
      for (std::int64_t k = draft_.cells.lo[2]; k < draft_.cells.hi[2]; ++k) {
        const std::size_t p = shape_.at(j, k), next = p + static_cast<std::size_t>(shape_.stride);
        const int face = plane.inside[p] | plane.inside[next] << 1 | plane.inside[p + 1] << 2 |
                         plane.inside[next + 1] << 3;
        const bool has_null = face > 15;
        plane.faces[p] = static_cast<std::uint8_t>(has_null ? kNull : face);
        plane.has_nulls = plane.has_nulls || has_null;
      }
    }
  }

  bool classify(std::int64_t i, std::uint8_t* signs, std::uint8_t* nulls) const {
    const Plane &lower = planes_[i & 1], &upper = planes_[(i + 1) & 1];
    for (std::int64_t j = draft_.cells.lo[1]; j < draft_.cells.hi[1]; ++j) {
      for (std::int64_t k = draft_.cells.lo[2]; k < draft_.cells.hi[2]; ++k) {
        const std::size_t p = shape_.at(j, k);
        nulls[p] = static_cast<std::uint8_t>((lower.faces[p] | upper.faces[p]) & kNull);
        signs[p] = static_cast<std::uint8_t>(spread(lower.faces[p]) | spread(upper.faces[p]) << 1);
      }
    }
    return lower.has_nulls || upper.has_nulls;
  }

  void intersect(std::int64_t i, const std::array<std::uint8_t*, 3>& crossing) const {
    const std::uint8_t* const lower = planes_[i & 1].inside.data();
    const std::uint8_t* const upper = planes_[(i + 1) & 1].inside.data();
    for (std::int64_t j = draft_.samples.lo[1]; j < draft_.samples.hi[1]; ++j) {
      for (std::int64_t k = draft_.samples.lo[2]; k < draft_.samples.hi[2]; ++k) {
        const std::size_t p = shape_.at(j, k);
        crossing[0][p] = differ(lower[p], upper[p]);
        crossing[1][p] = differ(lower[p], lower[p + static_cast<std::size_t>(shape_.stride)]);
        crossing[2][p] = differ(lower[p], lower[p + 1]);
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
