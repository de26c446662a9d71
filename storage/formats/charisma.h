// Charisma fault sticks, as interpretation systems exchange them: one knot a line,
//   INLINE- <inline> <crossline> <x> <y> <z> <fault name> <stick number>
// with the variants that are met in practice. A bad row is rejected with its place and reason and the rest
// goes on.
#pragma once
#include <filesystem>
#include <string_view>

#include "storage/formats/sticks.h"

namespace footwall::formats::charisma {

// Points are in the file's own X, Y and z; z is taken as positive down and, like its unit, noted in
// report.assumed. Sticks come in the order of their first row. Throws kNotFound, kIo, kFormat for a file in
// which no row is a fault stick (naming horizons where it has those), kMemory above 1 GiB.
SticksImport read(const std::filesystem::path& path, const SticksOptions& options = {});
// The same from text in memory.
SticksImport parse(std::string_view text, const SticksOptions& options = {});

}  // namespace footwall::formats::charisma
