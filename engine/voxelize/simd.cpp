#include "engine/voxelize/simd.h"

#include <hwy/targets.h>

#include "engine/voxelize/detail/row_loop.h"

namespace footwall::voxelize {
namespace {

constexpr std::int64_t kAbove128 = HWY_AVX3_DL | HWY_AVX3 | HWY_AVX2;

std::int64_t above(SimdLevel level) {
  switch (level) {
    case SimdLevel::kBaseline:
      return kAbove128 | HWY_SSE4 | HWY_SSSE3;
    case SimdLevel::kAvx2:
      return HWY_AVX3_DL | HWY_AVX3;
    case SimdLevel::kAvx512:
      break;
  }
  return 0;
}

void limit(SimdLevel level) {
  hwy::DisableTargets(above(level));
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());  // dispatch may have chosen already
}

}  // namespace

void apply_forced_simd() {
  static const bool applied = [] {
    if (const auto level = forced_simd()) limit(*level);
    return true;
  }();
  static_cast<void>(applied);
}

void limit_simd(std::optional<SimdLevel> level) {
  apply_forced_simd();
  if (level) {
    limit(*level);
  } else {
    hwy::DisableTargets(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
}

std::string simd_in_use() {
  apply_forced_simd();
  return detail::target_in_use();
}

}  // namespace footwall::voxelize
