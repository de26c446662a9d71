// Files that hold something other than fault sticks, told apart so that they can be refused by name.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace footwall::formats {

struct OtherFile {
  std::string what;  // "an IRAP classic grid"
  std::string hint;  // what to do with it
};

// Looks at the first 64 KiB of a file that no reader of sticks knows. GOCAD surfaces and other objects, VTK
// XML, grids (IRAP classic, ZMAP+, CPS-3, EarthVision), EarthVision points, SEG-Y, NRRD.
std::optional<OtherFile> recognise_other(std::string_view head);

}  // namespace footwall::formats
