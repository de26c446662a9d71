// The instruction set that the hot loops may use. Results never depend on it; forcing it lets a test show
// that.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace footwall {

enum class SimdLevel : std::uint8_t { kBaseline, kAvx2, kAvx512 };

// "baseline", "avx2", "avx512".
std::string_view name_of(SimdLevel level);
// Throws Error kUsage for any other text.
SimdLevel simd_level_from(std::string_view name);

// The level named by the environment variable FOOTWALL_SIMD, read once; nothing where it is unset or empty
// (then the best that the processor has is used). A level is a ceiling: avx512 on a processor without it uses
// what there is. Throws Error kUsage for a value that is no level.
std::optional<SimdLevel> forced_simd();

}  // namespace footwall
