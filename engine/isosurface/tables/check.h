// Whether an entry of the tables is right, found without the code that made it.
#pragma once
#include <string>

#include "engine/isosurface/tables/cases.h"

namespace footwall::isosurface::tables {

// What is wrong with the entry of these signs and this alternative; empty if nothing is:
// - on every face of the cell the contours part inside from outside corners, joined as the alternative says,
//   with the inside to their right as seen from outside the cell;
// - every other edge has two triangles, in opposite directions, and does not lie on a face of the cell,
// unless
//   the neighbour cannot have it (with `chords` any may);
// - the triangles around every vertex hang together, and every cut edge has its vertex;
// - the parts and the Euler number are those of discs, and of one ring if there is a tunnel.
std::string fault_of(unsigned signs, unsigned alternative, const Entry& entry, bool chords);

// Compares the tables with `samples` random trilinear fields for every sign case: the Euler number and the
// parts above and below the isovalue of the sampled level set must be those of the one alternative with the
// same faces. Returns what is wrong, empty if nothing is, and counts the alternatives that occurred.
std::string fault_against_samples(const std::vector<SignCase>& all, int samples, int& met);

}  // namespace footwall::isosurface::tables
