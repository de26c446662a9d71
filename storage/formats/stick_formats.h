// The formats of fault sticks: a new one is a file with its reader (and writer) and one row in the table.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats {

struct StickFormat {
  std::string_view name;   // as --format takes it
  std::string_view title;  // for people
  // True if `head`, the whole rows in the first 64 KiB of a file, is of this format; asked in the table's
  // order, after recognise_other(). nullptr: never told from the content.
  bool (*recognises)(std::string_view head);
  // The whole text. Throws kFormat where no row can be used.
  SticksImport (*parse)(std::string_view text, const SticksOptions& options);
  // The whole file as text; what the format cannot hold is changed and told in `renamed`. nullptr: only read.
  std::string (*write)(std::span<const Stick> sticks, const SticksWriteOptions& options,
                       std::vector<std::string>& renamed);
  // The file has no room for names: it holds one fault, whose name is told when it is read.
  bool one_fault = false;
};

std::span<const StickFormat> stick_formats();
// Throws kUsage listing the names for one that is not there.
const StickFormat& stick_format(std::string_view name);
// nullptr where no format knows the content.
const StickFormat* recognise_sticks(std::string_view head);

// Reads a file of the named format, or of the one that its content tells (empty name). Throws kNotFound, kIo,
// kUsage, kMemory above 1 GiB, and kFormat, saying what else the file is where that can be seen.
SticksImport read_sticks(const std::filesystem::path& path, std::string_view format,
                         const SticksOptions& options);

// Writes a file of the named format, whole or not at all; returns what had to be renamed. Throws kUsage for a
// format that is only read, and for several faults where it holds one; kInvalid without sticks; kNotFound,
// kIo as writing does.
std::vector<std::string> write_sticks(const std::filesystem::path& path, std::string_view format,
                                      std::span<const Stick> sticks, const SticksWriteOptions& options);

}  // namespace footwall::formats
