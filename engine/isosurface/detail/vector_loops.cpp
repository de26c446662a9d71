// Plain loops, which the compiler vectorizes for each of Highway's instruction sets.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/isosurface/detail/vector_loops.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include "engine/isosurface/detail/vector_loops.h"
#include "engine/isosurface/detail/vertex_arithmetic.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {
namespace {

bool to_booleans(const float* HWY_RESTRICT values, std::int64_t count, float isovalue,
                 std::uint8_t* HWY_RESTRICT inside, std::uint8_t* HWY_RESTRICT nulls) {
  int any = 0;
  for (std::int64_t n = 0; n < count; ++n) {
    const float value = values[n];
    const int null = value != value ? 1 : 0;
    inside[n] = static_cast<std::uint8_t>(value >= isovalue ? 1 : 0);
    nulls[n] = static_cast<std::uint8_t>(null);
    any |= null;
  }
  return any != 0;
}

// As crossing(), which a compiler does not take into another instruction set's loops by itself.
void interpolate(const float* HWY_RESTRICT lower, const float* HWY_RESTRICT upper, std::int64_t count,
                 float isovalue, float* HWY_RESTRICT into) {
  for (std::int64_t n = 0; n < count; ++n) {
    const float t = (isovalue - lower[n]) / (upper[n] - lower[n]);
    const float most = t <= kMostT ? t : kMostT;
    into[n] = most >= kLeastT ? most : kLeastT;
  }
}

void cross(const std::uint8_t* HWY_RESTRICT a, const std::uint8_t* HWY_RESTRICT b,
           const std::uint8_t* HWY_RESTRICT null_a, const std::uint8_t* HWY_RESTRICT null_b,
           std::int64_t count, std::uint8_t* HWY_RESTRICT into) {
  if (null_a == nullptr) {
    for (std::int64_t n = 0; n < count; ++n) into[n] = static_cast<std::uint8_t>(a[n] ^ b[n]);
  } else {
    for (std::int64_t n = 0; n < count; ++n) {
      into[n] = static_cast<std::uint8_t>((a[n] ^ b[n]) & ~(null_a[n] | null_b[n]));
    }
  }
}

void to_indices(const std::uint8_t* HWY_RESTRICT a, const std::uint8_t* HWY_RESTRICT b,
                const std::uint8_t* HWY_RESTRICT c, const std::uint8_t* HWY_RESTRICT d, std::int64_t count,
                std::uint8_t* HWY_RESTRICT into) {
  for (std::int64_t n = 0; n < count; ++n) {
    into[n] = static_cast<std::uint8_t>(a[n] + b[n] * 2 + c[n] * 4 + d[n] * 8 + a[n + 1] * 16 +
                                        b[n + 1] * 32 + c[n + 1] * 64 + d[n + 1] * 128);
  }
}

void any_of_cell(const std::uint8_t* HWY_RESTRICT a, const std::uint8_t* HWY_RESTRICT b,
                 const std::uint8_t* HWY_RESTRICT c, const std::uint8_t* HWY_RESTRICT d, std::int64_t count,
                 std::uint8_t* HWY_RESTRICT into) {
  for (std::int64_t n = 0; n < count; ++n) {
    into[n] =
        static_cast<std::uint8_t>(a[n] | b[n] | c[n] | d[n] | a[n + 1] | b[n + 1] | c[n + 1] | d[n + 1]);
  }
}

}  // namespace
}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::isosurface::detail {
namespace {

HWY_EXPORT(to_booleans);
HWY_EXPORT(interpolate);
HWY_EXPORT(cross);
HWY_EXPORT(to_indices);
HWY_EXPORT(any_of_cell);

}  // namespace

bool to_booleans(const float* values, std::int64_t count, float isovalue, std::uint8_t* inside,
                 std::uint8_t* nulls) {
  return HWY_DYNAMIC_DISPATCH(to_booleans)(values, count, isovalue, inside, nulls);
}

void interpolate(const float* lower, const float* upper, std::int64_t count, float isovalue, float* t) {
  HWY_DYNAMIC_DISPATCH(interpolate)(lower, upper, count, isovalue, t);
}

void cross(const std::array<const std::uint8_t*, 2>& inside, const std::array<const std::uint8_t*, 2>& nulls,
           std::int64_t count, std::uint8_t* crossing) {
  HWY_DYNAMIC_DISPATCH(cross)(inside[0], inside[1], nulls[0], nulls[1], count, crossing);
}

void to_indices(const std::array<const std::uint8_t*, 4>& inside, std::int64_t count, std::uint8_t* signs) {
  HWY_DYNAMIC_DISPATCH(to_indices)(inside[0], inside[1], inside[2], inside[3], count, signs);
}

void any_of_cell(const std::array<const std::uint8_t*, 4>& nulls, std::int64_t count, std::uint8_t* any) {
  HWY_DYNAMIC_DISPATCH(any_of_cell)(nulls[0], nulls[1], nulls[2], nulls[3], count, any);
}

}  // namespace footwall::isosurface::detail
#endif
