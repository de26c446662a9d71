// Charisma fault sticks, as interpretation systems exchange them: one knot a line,
//   INLINE- <inline> <crossline> <x> <y> <z> <fault name> <stick number>
// with the variants that are met in practice. A bad row is rejected with its place and reason and the rest
// goes on.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::charisma {

// True where a row starts with INLINE and a number; horizons do too, which parse() refuses by name.
bool recognises(std::string_view head);
// Points are in the file's own X, Y; a row whose X and Y are 0 0 or null is placed by its lines where the
// survey is known. Sticks come in the order of their first row. Throws kFormat for a text in which no row is
// a fault stick (naming horizons where it has those).
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// Inline and crossline are those of the nearest lines of the survey, 0 0 without one. x and y with 4
// decimals, sticks numbered from 1 in each fault.
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);

}  // namespace footwall::formats::charisma
