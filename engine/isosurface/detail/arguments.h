// What every way to extract may rely on.
#pragma once
#include "engine/isosurface/extract.h"

namespace footwall::isosurface::detail {

// Throws as extract() does, for what can be told without looking at a sample.
void check_arguments(const Field& field, float isovalue, const ExtractOptions& options);

}  // namespace footwall::isosurface::detail
