#include "storage/base/simd.h"

#include <fmt/format.h>

#include <cstdlib>

#include "storage/base/error.h"

namespace footwall {
std::string_view name_of(SimdLevel level) {
  if (level == SimdLevel::kBaseline) return "baseline";
  return level == SimdLevel::kAvx2 ? "avx2" : "avx512";
}

SimdLevel simd_level_from(std::string_view name) {
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (name == name_of(level)) return level;
  }
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is not an instruction set", name),
              "set FOOTWALL_SIMD to baseline, avx2 or avx512, or unset it");
}

std::optional<SimdLevel> forced_simd() {
  static const std::optional<SimdLevel> forced = []() -> std::optional<SimdLevel> {
    const char* value = std::getenv("FOOTWALL_SIMD");
    if (value == nullptr || *value == '\0') return std::nullopt;
    return simd_level_from(value);
  }();
  return forced;
}

}  // namespace footwall
