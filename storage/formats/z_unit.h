// Units of z in files: "ms", "s", "m", "ft".
#pragma once
#include <optional>
#include <string_view>

namespace footwall::formats {

// The unit meant by a word of a file in any case ("MSEC", "Feet", "metres" ...): "ms", "s", "m" or "ft";
// nothing for a word that names none of them.
std::optional<std::string_view> z_unit_from(std::string_view word);

// z in `from` times this is z in `to`. Throws kUsage for a unit not listed above, and between time and depth,
// which only a velocity could convert.
double z_unit_factor(std::string_view from, std::string_view to);

// Digits after the point that resolve 1e-4 ms, m or ft, and as much in seconds.
int z_decimals(std::string_view unit);

}  // namespace footwall::formats
