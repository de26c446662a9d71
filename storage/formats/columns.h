// Fault sticks in a table whose columns the user names, or that names them itself in its first row.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::columns {

// "name=6,x=3,y=4,z=5,stick=7,node=8,inline=1,crossline=2": columns from 1. Throws kUsage for anything else,
// for a column that is named twice, and without z and either X and Y or inline and crossline.
ColumnMap map_from(std::string_view text);
// "comma", "semicolon", "tab", "blank" or one character. Throws kUsage.
char delimiter_from(std::string_view name);

// True where the first row is headings that name X, Y and z, and the next rows have numbers there.
bool recognises(std::string_view head);
// By options.columns, else by the headings in the first row, which the report lists as assumed. A blank line
// parts sticks without numbers, and so does a node number that does not rise. A blank field stands for a
// value that is not there. Throws kUsage without either, kFormat where no row can be used.
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// Comma separated, with headings: name,stick,node,x,y,z, and inline,crossline of the nearest lines where the
// survey is known.
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);

}  // namespace footwall::formats::columns
