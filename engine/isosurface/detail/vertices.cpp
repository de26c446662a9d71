// Compiled once per instruction set and chosen at run time; every operation is rounded alike on all of them
// (vertex_arithmetic.h, no fused multiply-add), so that each gives the same bits.
#define HWY_WANT_AVX3_DL 1  // it lists the bits of a word at once
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/detail/vertices.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "engine/isosurface/detail/list_bits-inl.h"
#include "engine/isosurface/detail/vertex_arithmetic.h"
#include "engine/isosurface/detail/vertices.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Float = hn::Vec<Floats>;
using Int = hn::Vec<Ints>;
constexpr Floats kFloats{};
constexpr Ints kInts{};
constexpr std::size_t kStep = hn::MaxLanes(Floats());

void list_plane(const Frame& frame, const PlaneMasks& here, const SlowCell* slow, const SlowCell* slow_end,
                VertexList& into) {
  std::int32_t* HWY_RESTRICT offset = into.offset.data();
  std::int32_t* HWY_RESTRICT place = into.place.data();
  for (std::int64_t r = here.from; r < here.to; ++r) {
    const PlaneMasks::RowCounts& counts = here.counts[static_cast<std::size_t>(r)];
    if (!counts.any) continue;
    const auto j = static_cast<std::int32_t>(frame.cells.lo[1] + r);
    const auto row = static_cast<std::int32_t>(j * frame.row_step);
    const WordMasks* const words = here.words.data() + static_cast<std::size_t>(r) * frame.words;
    for (const std::size_t axis : {2U, 1U, 0U}) {
      if (counts.edges[axis] == 0) continue;
      const Int value = hn::Set(kInts, 4 * j + static_cast<std::int32_t>(axis));
      for (std::uint32_t n = 0; n < counts.edges[axis]; n += kStep) hn::StoreU(value, kInts, place + n);
      place += counts.edges[axis];
      auto first = row;
      for (std::size_t w = 0; w < frame.words; ++w, first += 64) {
        offset = list_bits(words[w].edges[axis], first, offset);
      }
    }
    for (; slow != slow_end && slow->r == static_cast<std::uint32_t>(r); ++slow) {
      if (!slow->has_centre) continue;
      *offset++ = row + static_cast<std::int32_t>(slow->k);
      *place++ = 4 * j + 3;
    }
  }
}

struct Vector {
  Float i;
  Float j;
  Float k;
};
// The index of samples on one axis, and the last one that there is.
struct Along {
  Int at;
  Int last;
};

// twice_derivative(). Not careful: both neighbours are in the field, and the result is no number where one is
// null.
template <bool kCareful>
HWY_INLINE Float slope(const float* HWY_RESTRICT base, Int offset, [[maybe_unused]] Float value, Int step,
                       [[maybe_unused]] const Along& along) {
  if constexpr (!kCareful) {
    return hn::Sub(hn::GatherIndex(kFloats, base, hn::Add(offset, step)),
                   hn::GatherIndex(kFloats, base, hn::Sub(offset, step)));
  } else {
    const auto is_last = hn::Eq(along.at, along.last);
    const auto is_first = hn::Eq(along.at, hn::Zero(kInts));
    const auto above = hn::GatherIndex(kFloats, base, hn::Add(offset, hn::IfThenZeroElse(is_last, step)));
    const auto below = hn::GatherIndex(kFloats, base, hn::Sub(offset, hn::IfThenZeroElse(is_first, step)));
    const auto no_above = hn::Or(hn::RebindMask(kFloats, is_last), hn::IsNaN(above));
    const auto no_below = hn::Or(hn::RebindMask(kFloats, is_first), hn::IsNaN(below));
    const auto rise = hn::Sub(hn::IfThenElse(no_above, value, above), hn::IfThenElse(no_below, value, below));
    return hn::IfThenElse(hn::Xor(no_above, no_below), hn::Add(rise, rise), rise);
  }
}

// The vertices of one plane, kStep at a time.
class Plane {
 public:
  Plane(const Frame& frame, std::int64_t p)
      : base_(frame.samples(p, 0) - frame.cells.lo[1] * frame.row_step),
        isovalue_(hn::Set(kFloats, frame.isovalue)),
        row_step_(narrowed(frame.row_step)),
        plane_step_(narrowed(frame.plane_step)),
        i_(narrowed(frame.cells.lo[0] + p)),
        last_i_(narrowed(frame.field->size[0] - 1)),
        last_j_(narrowed(frame.field->size[1] - 1)),
        last_k_(narrowed(frame.field->size[2] - 1)),
        origin_i_(real(frame.field->origin[0] + frame.cells.lo[0] + p)),
        origin_j_(narrowed(frame.field->origin[1])),
        origin_k_(narrowed(frame.field->origin[2])) {}

  // positions and normals: room for kStep; normals may be null.
  HWY_INLINE void make(const std::int32_t* HWY_RESTRICT offsets, const std::int32_t* HWY_RESTRICT places,
                       float* HWY_RESTRICT positions, float* HWY_RESTRICT normals) const {
    const Int offset = hn::LoadU(kInts, offsets);
    const Int place = hn::LoadU(kInts, places);
    const Int axis = hn::And(place, hn::Set(kInts, 3));
    const Int j = hn::ShiftRight<2>(place);
    const Int k = hn::Sub(offset, hn::Mul(j, row_step_));
    const auto on_i = hn::Eq(axis, hn::Zero(kInts));
    const auto on_j = hn::Eq(axis, hn::Set(kInts, 1));
    const auto on_k = hn::Gt(axis, hn::Set(kInts, 1));
    const Int one = hn::Set(kInts, 1);
    const Int step = hn::IfThenElse(on_i, plane_step_, hn::IfThenElse(on_j, row_step_, one));
    const Int upper = hn::Add(offset, step);
    const Float a = hn::GatherIndex(kFloats, base_, offset);
    const Float b = hn::GatherIndex(kFloats, base_, upper);

    Float t = hn::Div(hn::Sub(isovalue_, a), hn::Sub(b, a));
    const Float most = hn::Set(kFloats, kMostT);
    const Float least = hn::Set(kFloats, kLeastT);
    t = hn::IfThenElse(hn::Le(t, most), t, most);
    t = hn::IfThenElse(hn::Ge(t, least), t, least);
    const auto float_i = hn::RebindMask(kFloats, on_i);
    const auto float_j = hn::RebindMask(kFloats, on_j);
    const auto float_k = hn::RebindMask(kFloats, on_k);
    hn::StoreInterleaved3(
        hn::Add(origin_i_, hn::IfThenElseZero(float_i, t)),
        hn::Add(hn::ConvertTo(kFloats, hn::Add(origin_j_, j)), hn::IfThenElseZero(float_j, t)),
        hn::Add(hn::ConvertTo(kFloats, hn::Add(origin_k_, k)), hn::IfThenElseZero(float_k, t)), kFloats,
        positions);
    if (normals == nullptr) return;

    const Along lower_i{i_, last_i_};
    const Along lower_j{j, last_j_};
    const Along lower_k{k, last_k_};
    const Along upper_i{hn::IfThenElse(on_i, hn::Add(i_, one), i_), last_i_};
    const Along upper_j{hn::IfThenElse(on_j, hn::Add(j, one), j), last_j_};
    const Along upper_k{hn::IfThenElse(on_k, hn::Add(k, one), k), last_k_};
    const auto between = [&]<bool kCareful>() HWY_ATTR {
      const auto mean = [&](Int along_step, const Along& at_lower, const Along& at_upper) HWY_ATTR {
        const Float low = slope<kCareful>(base_, offset, a, along_step, at_lower);
        const Float high = slope<kCareful>(base_, upper, b, along_step, at_upper);
        return hn::Add(low, hn::Mul(t, hn::Sub(high, low)));
      };
      return Vector{mean(plane_step_, lower_i, upper_i), mean(row_step_, lower_j, upper_j),
                    mean(one, lower_k, upper_k)};
    };
    // Neighbours that the field does not have must not even be read.
    const auto at_border =
        hn::Or(hn::Or(hn::Or(hn::Eq(lower_i.at, hn::Zero(kInts)), hn::Eq(upper_i.at, last_i_)),
                      hn::Or(hn::Eq(lower_j.at, hn::Zero(kInts)), hn::Eq(upper_j.at, last_j_))),
               hn::Or(hn::Eq(lower_k.at, hn::Zero(kInts)), hn::Eq(upper_k.at, last_k_)));
    Vector g{a, a, a};
    Int magnitude = hn::Zero(kInts);
    const Int infinity = hn::Set(kInts, static_cast<std::int32_t>(kInfinity));
    bool careful = !hn::AllFalse(kInts, at_border);
    if (HWY_LIKELY(!careful)) {
      g = between.template operator()<false>();
      magnitude = largest(g);
      careful = !hn::AllFalse(kInts, hn::Gt(magnitude, infinity));  // no number: a neighbour may be null
    }
    if (HWY_UNLIKELY(careful)) {
      g = between.template operator()<true>();
      magnitude = largest(g);
    }

    const auto none = hn::RebindMask(
        kFloats, hn::Or(hn::Eq(magnitude, hn::Zero(kInts)), hn::Gt(magnitude, hn::Sub(infinity, one))));
    const Int exponent = hn::Max(hn::Sub(hn::Set(kInts, 253), hn::ShiftRight<23>(magnitude)), one);
    const Float scale = hn::BitCast(kFloats, hn::ShiftLeft<23>(exponent));
    const Float vi = hn::Mul(g.i, scale);
    const Float vj = hn::Mul(g.j, scale);
    const Float vk = hn::Mul(g.k, scale);
    const Float square = hn::Add(hn::Add(hn::Mul(vi, vi), hn::Mul(vj, vj)), hn::Mul(vk, vk));
    const Float inverse = hn::Div(hn::Set(kFloats, -1.0F), hn::Sqrt(square));
    const Float along = hn::IfThenElse(hn::Ge(a, isovalue_), hn::Set(kFloats, 1.0F), hn::Set(kFloats, -1.0F));
    hn::StoreInterleaved3(hn::IfThenElse(none, hn::IfThenElseZero(float_i, along), hn::Mul(vi, inverse)),
                          hn::IfThenElse(none, hn::IfThenElseZero(float_j, along), hn::Mul(vj, inverse)),
                          hn::IfThenElse(none, hn::IfThenElseZero(float_k, along), hn::Mul(vk, inverse)),
                          kFloats, normals);
  }

 private:
  static HWY_INLINE Int narrowed(std::int64_t value) {
    return hn::Set(kInts, static_cast<std::int32_t>(value));
  }
  static HWY_INLINE Float real(std::int64_t value) {
    return hn::Set(kFloats, static_cast<float>(static_cast<std::int32_t>(value)));
  }
  // The bits of the largest magnitude: as whole numbers they are in the same order, with what is no number on
  // top.
  static HWY_INLINE Int largest(const Vector& g) {
    const Int magnitude = hn::Set(kInts, static_cast<std::int32_t>(kMagnitude));
    return hn::Max(
        hn::Max(hn::And(hn::BitCast(kInts, g.i), magnitude), hn::And(hn::BitCast(kInts, g.j), magnitude)),
        hn::And(hn::BitCast(kInts, g.k), magnitude));
  }

  const float* base_;
  Float isovalue_;
  Int row_step_;
  Int plane_step_;
  Int i_;
  Int last_i_;
  Int last_j_;
  Int last_k_;
  Float origin_i_;
  Int origin_j_;
  Int origin_k_;
};

void write_plane(const Frame& frame, std::int64_t p, const VertexList& list, Point* positions, Point* normals,
                 LinesAhead& ahead) {
  static_assert(sizeof(Point) == 3 * sizeof(float));
  const Plane plane(frame, p);
  auto* position = reinterpret_cast<float*>(positions);
  auto* normal = reinterpret_cast<float*>(normals);
  std::size_t at = 0;
  for (; at + kStep <= list.count; at += kStep) {
    ahead.ask(kStep / 2);
    plane.make(list.offset.data() + at, list.place.data() + at, position, normal);
    position += 3 * kStep;
    if (normal != nullptr) normal += 3 * kStep;
  }
  const std::size_t left = list.count - at;
  if (left == 0) return;
  // The last ones: the vector is filled up with copies of the last vertex.
  std::int32_t offsets[kStep];
  std::int32_t places[kStep];
  float made[2][3 * kStep];
  for (std::size_t n = 0; n < kStep; ++n) {
    offsets[n] = list.offset[at + std::min(n, left - 1)];
    places[n] = list.place[at + std::min(n, left - 1)];
  }
  plane.make(offsets, places, made[0], normal == nullptr ? nullptr : made[1]);
  std::copy_n(made[0], 3 * left, position);
  if (normal != nullptr) std::copy_n(made[1], 3 * left, normal);
}

}  // namespace
}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface::detail {
namespace {

HWY_EXPORT(list_plane);
HWY_EXPORT(write_plane);

}  // namespace

void list_vertices(const Frame& frame, const PlaneMasks& here, std::span<const SlowCell> slow,
                   VertexList& into) {
  into.count = 0;
  for (std::int64_t r = here.from; r < here.to; ++r) {
    const PlaneMasks::RowCounts& counts = here.counts[static_cast<std::size_t>(r)];
    if (counts.any) into.count += counts.edges[0] + counts.edges[1] + counts.edges[2] + counts.centres;
  }
  constexpr std::size_t kSlack = 64;  // kListSlack, and a vector
  static_assert(kSlack >= kListSlack && kSlack >= HWY_MAX_BYTES / sizeof(std::int32_t));
  if (into.offset.size() < into.count + kSlack) {
    into.offset.resize(into.count + kSlack);
    into.place.resize(into.count + kSlack);
  }
  HWY_DYNAMIC_DISPATCH(list_plane)(frame, here, slow.data(), slow.data() + slow.size(), into);
}

void write_vertices(const Frame& frame, std::int64_t p, const VertexList& list, Point* positions,
                    Point* normals, VertexKey* keys, LinesAhead& ahead) {
  HWY_DYNAMIC_DISPATCH(write_plane)(frame, p, list, positions, normals, ahead);
  if (keys == nullptr) return;
  const Field& field = *frame.field;
  for (std::size_t n = 0; n < list.count; ++n) {
    const std::int64_t j = list.place[n] >> 2;
    const std::int64_t k = list.offset[n] - j * frame.row_step;
    const std::int64_t row =
        (field.origin[0] + frame.cells.lo[0] + p) * field.volume_size[1] + field.origin[1] + j;
    keys[n] = 4 * static_cast<VertexKey>(row * field.volume_size[2] + field.origin[2] + k) +
              static_cast<VertexKey>(list.place[n] & 3);
  }
}

void write_centres(std::span<const CentreLoop> centres, Point* positions, Point* normals) {
  for (const CentreLoop& centre : centres) {
    const auto loop = std::span(centre.around).first(centre.count);
    positions[centre.vertex] = centre_position(loop, positions);
    if (normals != nullptr) normals[centre.vertex] = centre_normal(loop, normals);
  }
}

}  // namespace footwall::isosurface::detail
#endif
