// Landmark SeisWorks faults: a file of fixed columns, which a second file, the format file, describes in rows
// `FAULT_X first last` (columns from 1, both within).
// Based on: the names that OpendTect's translator uses. No file of the vendor was at hand.
#pragma once
#include <string_view>

#include "storage/formats/sticks.h"

namespace footwall::formats::landmark {

// options.layout is the text of the format file: FAULT_X and FAULT_Y, or FAULT_LINEID and FAULT_TRACE (inline
// and crossline); FAULT_Z and FAULT_PTYPE; and, where they are there, FAULT_DOMAIN, FAULT_DOMAIN_UNIT,
// FAULT_DISTANCE_UNIT and FAULT_NAME. Point types: 1 starts a stick, 2 goes on, 3 ends it, 4 is a control
// point and taken for one of its stick. Throws kUsage without a layout, kFormat for one that lacks a column,
// or where no row is a point.
SticksImport parse(std::string_view text, const SticksOptions& options = {});

}  // namespace footwall::formats::landmark
