// Units of coordinates as files and options name them.
#pragma once
#include <string_view>

namespace footwall::formats {

// "m", "ft", "ms" or "s" for a word as files spell it ("Metres", "FEET", "msec", "\"m\""); empty for one that
// is not known.
std::string_view unit_from(std::string_view word);

// What a number in `from` is multiplied by to be in `to`: ms and s, or m and the international foot. Throws
// kInvalid between a time and a length, and for a unit that is none of the four.
double unit_factor(std::string_view from, std::string_view to);

}  // namespace footwall::formats
