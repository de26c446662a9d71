// OpendTect's fault sticks in ASCII, tab separated, as its export writes them:
//   X Y Z [stick] [node] [line]            one fault, no name
//   "name" X Y Z [stick] [node] [line]     bulk, several faults
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::opendtect_sticks {

// Most rows are of three to five numbers between tabs, after them perhaps the name of a line.
bool recognises(std::string_view head);
// Most rows start with a quoted name.
bool recognises_bulk(std::string_view head);
// Both forms. A fourth column that starts again and again while the rows go on counts nodes, not sticks (the
// export offers either); that is listed as assumed. Throws kFormat where no row can be used.
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// One fault: X Y Z stick node, counted from 0 as OpendTect does.
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);
std::string write_bulk(std::span<const Stick> sticks, const SticksWriteOptions& options,
                       std::vector<std::string>& renamed);

}  // namespace footwall::formats::opendtect_sticks
