// From what the headers say to the survey's geometry.
#pragma once
#include "storage/formats/segy/header_scan.h"

namespace footwall::formats::segy {

// Settles the scan's index (one live entry a bin is left) and makes the geometry; fills the report's counts,
// residual and warnings. Throws kUnsupported for prestack files, kInvalid where the line numbers make no
// grid, kFormat without a usable sample interval.
survey::Geometry make_geometry(const detail::ReadOnlyFile& file, const Layout& layout, const Options& options,
                               const HeaderBytes& at, HeaderScan& scan, Report& report);

}  // namespace footwall::formats::segy
