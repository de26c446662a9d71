// Two pictures of surfaces laid into one.
#pragma once
#include "engine/render/surface_layer.h"

namespace footwall::render {

// The nearer of each pixel; where both are as far away, that of `first`. Throws Error kInternal unless both
// are of one size.
SurfaceLayer nearer_of(const SurfaceLayer& first, const SurfaceLayer& second);

}  // namespace footwall::render
