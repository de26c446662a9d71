// Fault sticks as bare rows of numbers:
//   x y z stick [node]      numbered sticks
//   x y z                   sticks parted by blank lines (DUG's .dufault), or told by a change of plane
// Fields stand between blanks, tabs, commas or semicolons. Such files hold no names, so one fault each.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::xyz_sticks {

// Most rows are of three numbers, in groups between blank lines.
bool recognises_groups(std::string_view head);
// Most rows are of three to five numbers.
bool recognises(std::string_view head);
// The first row tells whether sticks are numbered. Throws kFormat where no row can be used.
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// The same, but sticks without numbers are parted by blank lines alone.
SticksImport parse_groups(std::string_view text, const SticksOptions& options = {});
// x y z stick, blanks between, numbered from 1.
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);
// x y z, a blank line between sticks.
std::string write_groups(std::span<const Stick> sticks, const SticksWriteOptions& options,
                         std::vector<std::string>& renamed);

}  // namespace footwall::formats::xyz_sticks
