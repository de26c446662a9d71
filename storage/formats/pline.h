// GOCAD PLine (.pl): polylines as `ILINE`, `VRTX id x y z`, `SEG id id`; several objects a file.
// Based on: the GOCAD ASCII format as public readers and writers have it.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::pline {

// A row "GOCAD PLine" or "GOCAD VSet" is in the head.
bool recognises(std::string_view head);
// Sticks of object F belong to fault F and are numbered from 1 in the order of the file. Points are ordered
// along the chains of SEG: a chain starts at its end that comes first in the file, a closed one at its first
// point, which it repeats at its end; where more than two segments meet, a chain ends. An ILINE without SEG
// joins its points in their order; a point that no SEG names is a stick of one. VRTX, PVRTX and ATOM by id,
// ids from anywhere; every point of a VSet is a stick of one. z by ZPOSITIVE and AXIS_UNIT; without ZPOSITIVE
// it is elevation, which is GOCAD's default, and told as assumed. Throws kFormat where there is no polyline,
// kMemory beyond 10 million points.
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// One object a fault, one ILINE a stick, ZPOSITIVE and AXIS_UNIT stated, coordinates with four decimals (z in
// seconds with seven).
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);

}  // namespace footwall::formats::pline
