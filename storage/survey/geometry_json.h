// A survey's geometry as JSON: what stands in volume files, jobs and reports. nlohmann's types are in the
// signatures: who includes this links nlohmann_json.
//
// {inlines{first, step, count}, crosslines{first, step, count}, samples, z0, interval, domain "time"|"depth",
// vertical_unit "ms"|"m"|"ft", horizontal_unit "m"|"ft", crs, map{origin_x, origin_y, per_inline_x,
// per_inline_y, per_crossline_x, per_crossline_y}, assumed[]}
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "storage/survey/geometry.h"

namespace footwall::survey {

// Keys in alphabetical order, so that equal geometries give equal texts.
nlohmann::json geometry_to_json(const Geometry& geometry);
// The inverse, validated. Throws Error kInvalid (see Geometry::validate), kUsage (an unknown domain or unit),
// and nlohmann's exceptions for what is missing or of another type.
Geometry geometry_from_json(const nlohmann::json& json);

}  // namespace footwall::survey
