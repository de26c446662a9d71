#include "engine/isosurface/vector.h"

#include <vector>

#include "engine/isosurface/detail/half_table.h"
#include "engine/isosurface/detail/sweep.h"
#include "engine/isosurface/detail/vector_loops.h"

namespace footwall::isosurface {
namespace {

// The paper's arrays, of two planes: the booleans, the index of each cell, the intersections of all edges of
// each axis.
class Arrays {
 public:
  Arrays(const detail::Draft& draft, const detail::PlaneShape& shape) : draft_(draft), shape_(shape) {
    for (Plane& plane : planes_) {
      plane.inside.resize(shape.room());
      plane.nulls.resize(shape.room());
    }
    for (auto& axis : t_) axis.resize(shape.room());
  }

  void look_at(std::int64_t i) {
    Plane& plane = planes_[i & 1];
    plane.has_nulls = false;
    for_each_row([&](std::int64_t j, std::size_t p) {
      const bool found = detail::to_booleans(draft_.at(i, j, shape_.first_k), shape_.columns, draft_.isovalue,
                                             plane.inside.data() + p, plane.nulls.data() + p);
      plane.has_nulls = plane.has_nulls || found;
    });
  }

  // A plane's cells are one array; those at the dummies have signs that mean nothing and are not looked at.
  bool classify(std::int64_t i, std::uint8_t* signs, std::uint8_t* nulls) const {
    const Plane &lower = planes_[i & 1], &upper = planes_[(i + 1) & 1];
    const std::size_t first = shape_.at(shape_.first_j, shape_.first_k);
    const std::int64_t count = (shape_.rows - 1) * shape_.stride;
    const auto rows = [&](const auto& of) {
      const std::uint8_t *const a = of(lower) + first, *const b = of(upper) + first;
      return std::array{a, b, a + shape_.stride, b + shape_.stride};
    };
    detail::to_indices(rows([](const Plane& plane) { return plane.inside.data(); }), count, signs + first);
    const bool has_nulls = lower.has_nulls || upper.has_nulls;
    if (has_nulls || nulls_written_[i & 1]) {
      detail::any_of_cell(rows([](const Plane& plane) { return plane.nulls.data(); }), count, nulls + first);
      nulls_written_[i & 1] = has_nulls;
    }
    return has_nulls;
  }

  void intersect(std::int64_t i, const std::array<std::uint8_t*, 3>& crossing) {
    const Plane& plane = planes_[i & 1];
    const std::size_t first = shape_.at(shape_.first_j, shape_.first_k);
    const std::int64_t count = shape_.rows * shape_.stride;
    const bool to_next = i + 1 < draft_.samples.hi[0];
    const std::array<std::int64_t, 3> step{0, shape_.stride, 1};
    for (const int axis : {0, 1, 2}) {
      if (axis == 0 && !to_next) continue;
      const Plane& other = axis == 0 ? planes_[(i + 1) & 1] : plane;
      const bool has_nulls = plane.has_nulls || other.has_nulls;
      const auto pair = [&](const auto& of) {
        return std::array{of(plane) + first, of(other) + first + step[axis]};
      };
      const std::array<const std::uint8_t*, 2> none{nullptr, nullptr};
      detail::cross(pair([](const Plane& each) { return each.inside.data(); }),
                    has_nulls ? pair([](const Plane& each) { return each.nulls.data(); }) : none, count,
                    crossing[axis] + first);
      for_each_row([&](std::int64_t j, std::size_t p) {
        if (axis == 1 && j + 1 == draft_.samples.hi[1]) return;
        const float* const lower = draft_.at(i, j, shape_.first_k);
        const std::int64_t edges = shape_.columns - (axis == 2 ? 1 : 0);
        detail::interpolate(lower, lower + draft_.step(axis), edges, draft_.isovalue, t_[axis].data() + p);
      });
    }
  }

  float t(int axis, std::int64_t, std::int64_t j, std::int64_t k) const { return t_[axis][shape_.at(j, k)]; }

  Point gradient(std::int64_t i, std::int64_t j, std::int64_t k) const { return draft_.gradient_at(i, j, k); }

 private:
  template <class Visit>
  void for_each_row(Visit&& visit) const {
    for (std::int64_t j = draft_.samples.lo[1]; j < draft_.samples.hi[1]; ++j) {
      visit(j, shape_.at(j, shape_.first_k));
    }
  }

  struct Plane {
    std::vector<std::uint8_t> inside, nulls;
    bool has_nulls = false;
  };
  const detail::Draft& draft_;
  const detail::PlaneShape& shape_;
  std::array<Plane, 2> planes_;  // [i & 1]
  std::array<std::vector<float>, 3> t_;
  mutable std::array<bool, 2> nulls_written_{false, false};
};

}  // namespace

void extract_vector(const Field& field, float isovalue, const ExtractOptions& options, Surface& into) {
  detail::Draft draft(field, isovalue, options, "vector");
  static const detail::HalfTable table;
  detail::Sweep<Arrays, detail::HalfTable>(draft, table).run();
  draft.hand_over(into);
}

void extract_vector(const Field& field, float isovalue, const ExtractOptions& options, const CaseRules& rules,
                    Surface& into) {
  detail::Draft draft(field, isovalue, options, "vector");
  const detail::PatternTable table(rules);
  detail::Sweep<Arrays, detail::PatternTable>(draft, table).run();
  draft.hand_over(into);
}

}  // namespace footwall::isosurface
