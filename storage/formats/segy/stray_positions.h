// Traces whose coordinates are damaged, and the map without them.
#pragma once
#include <cstdint>
#include <optional>

#include "storage/formats/segy/header_scan.h"

namespace footwall::formats::segy {

struct FitWithoutStrays {
  MapFit fit;
  double farthest = 0;        // traces farther than this from the fit are left out
  std::int64_t left_out = 0;  // at least one
};

// A few wild coordinates among good ones (a header word that was never filled, a scalar that was applied
// twice) pull the least-squares map far away from everybody. Where leaving out at most 2 % of the traces
// brings the others onto a grid to a tenth of a bin, that map is returned; else nothing. `all` is the fit of
// all traces.
std::optional<FitWithoutStrays> fit_without_strays(const HeaderScan& scan, const MapFit& all);

}  // namespace footwall::formats::segy
