// OpenWorks fault planes: `New Fault Plane, version 1.10`, a row with the name in its first 60 characters and
// the domain, then per stick `Fault Segment`, two rows that describe it, and rows `x y z`.
// Based on: one public converter to this format, not on the vendor's description; so it is read, not written.
#pragma once
#include <string_view>

#include "storage/formats/sticks.h"

namespace footwall::formats::openworks {

bool recognises(std::string_view head);
// A fault a plane, a stick a segment. A segment that has another number of points than it states is told in
// report.assumed. Throws kFormat where there is no point; kUsage for TIME in a depth survey and the converse.
SticksImport parse(std::string_view text, const SticksOptions& options = {});

}  // namespace footwall::formats::openworks
