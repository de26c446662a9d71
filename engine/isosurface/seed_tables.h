// The rules of the seeds for ambiguous cells, kept to be compared with: none of them looks at the interior,
// and all of them fan polygons from their first vertex.
#pragma once
#include <string_view>

#include "engine/isosurface/case_tables.h"

namespace footwall::isosurface {

// Seed 000, section 1: on an ambiguous face each intersection is joined to the one next to the nearer corner,
// found by comparing the positions (float32) of the intersections on opposite edges. Equal positions join the
// corners at or above the isovalue.
const CaseRules& seed_000_rules();

// Seed 002, section 2.2: 128 entries; signs from 128 on use the entry of 255 - signs turned over. The seed
// does not say how its entries cut ambiguous faces; as in Lorensen and Cline's fourteen cases, the corners
// of the side that has fewer are kept apart, and with four on both sides those of the entry's marked side
// (at or above the isovalue for signs below 128). Two cells may cut their common face in different ways.
const CaseRules& seed_002_rules();

// trilinear, seed000 or seed002. Throws Error kUsage naming them.
const CaseRules& rules_of(std::string_view name);

}  // namespace footwall::isosurface
