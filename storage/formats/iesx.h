// GeoFrame IESX card images: `PROFILE name TYPE ...`, then rows in fixed columns (from 1): x 1-16, y 17-32,
// segment 33-35, type 36-38, z 39-47; `EOD` ends a profile.
// Based on: the columns that OpendTect writes and DUG Insight reads, and the vendor's note on the least that
// a file of fault boundaries must have. No fault file written by GeoFrame was at hand, and the codes that its
// header needs for faults are not public: the format is read and not written.
#pragma once
#include <string_view>

#include "storage/formats/sticks.h"

namespace footwall::formats::iesx {

// A row that starts with PROFILE and holds TYPE is in the head.
bool recognises(std::string_view head);
// A profile is a fault, a segment a stick. Variants: `EOD` in front of a row; rows that start with a tab (an
// echo of the row before) are skipped; a segment number of seven digits in columns 33-39, z after it;
// profiles of TYPE 3 (fault boundaries) with x and y before column 29, the segment in columns 29-31 and z
// after it. Rows whose z overflows its columns hold the null value. Profiles of horizons are left out, each
// rejected by name. Throws kFormat where nothing but horizons is in the file.
SticksImport parse(std::string_view text, const SticksOptions& options = {});

}  // namespace footwall::formats::iesx
