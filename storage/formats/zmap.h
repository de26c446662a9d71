// ZMAP+ lines: comments from '!', `@FREE POINT, DATA, 80, 1`, a row a field with its columns, `@`, then rows
// in these columns. Based on: files that RMS writes.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::zmap {

// A row '@... FREE POINT' is in the head.
bool recognises(std::string_view head);
// The fields' rows are read up to the second '@', however many they are; a stick a segment number, and where
// there is none each row is a point, a stick of one. Rows that the stated columns do not fit are split at
// blanks, which is told in report.assumed. Throws kFormat for a grid, and for fields without X, Y or Z.
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// One fault a file: the format has no place for its name. Unit and direction of z are told in a comment,
// which the reader takes.
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);

}  // namespace footwall::formats::zmap
