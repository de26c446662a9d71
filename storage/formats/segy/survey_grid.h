// From what the headers say to the survey's geometry.
#pragma once
#include "storage/formats/segy/header_scan.h"

namespace footwall::formats::segy {

// Settles the scan's index (one live entry a bin is left) and sets the geometry's lines; fills the report's
// counts, gaps and warnings. Throws kUnsupported for prestack files, kInvalid where the line numbers make no
// grid.
void set_lines(const detail::ReadOnlyFile& file, const Layout& layout, const HeaderBytes& at,
               HeaderScan& scan, survey::Geometry& geometry, Report& report);

// The rest of the geometry, after its lines: map, samples, units; fills the report's residuals, conflicts and
// warnings. Throws kFormat without a usable sample interval, kInvalid.
void set_map_and_samples(const Layout& layout, const Options& options, const HeaderScan& scan,
                         survey::Geometry& geometry, Report& report);

// True where the traces' coordinate scalars differ and their positions, each by its own, are no grid: most
// likely one scalar holds for all.
bool scalars_are_doubtful(const HeaderScan& scan);
// True where the traces lie within a tenth of a bin of a grid.
bool lies_on_grid(const HeaderScan& scan);

}  // namespace footwall::formats::segy
