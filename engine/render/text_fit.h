// Text that keeps to the room it is given: names come from users and have any length.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/typeface.h"

namespace footwall::render {

// The text, or as much of its beginning as fits with "…" after it.
std::string fitted(Typeface& typeface, std::string_view text, double size, bool bold, double room);

// Lines no wider than the room: broken at line ends and between words; a word too long is shortened. What
// does not fit in `most` lines is left off.
std::vector<std::string> wrapped(Typeface& typeface, std::string_view text, double size, double room,
                                 std::size_t most);

}  // namespace footwall::render
