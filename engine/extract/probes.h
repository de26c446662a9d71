// Contrast and offset: how much more discontinuous the volume is on a face than on copies of the face that
// are moved along its normal ("probes").
//
//   contrast(F) = D(F) - (D(F + 6 n) + D(F - 6 n)) / 2       D = discontinuity, n = F's unit normal in voxels
//   offset(F)   = the shift s in -8..8 voxels with the highest D(F + s n); its score is that D
//
// A probe is a face like any other: it is voxelized as exactly, its sums are as exact, and both numbers are
// the same for any rank count and strategy. Probes always travel as partial sums (exchange/reduce.cpp), also
// where the faces' own voxels are moved. What has fewer than 30 samples, or no discontinuity, is null: a
// contrast with such a probe (not: such a face) is null, an offset leaves such shifts out, and is null where
// none is left. A face without area has neither.
//
// The sign of n. Contrast does not depend on it. Offsets are first counted along the normal of the face's
// winding; of equally high shifts the nearest counts, of two equally near the one on the winding's side. Then
// orient_offsets() turns the signs so that the mean normal of the fault has a positive first component that
// is not zero. So an edit of one face changes what was computed of that face alone, and at most the sign of
// all offsets of its fault: where the edit turns the mean normal over, orient_offsets() over the unoriented
// values is all that has to be done again.
#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "engine/extract/face.h"
#include "storage/base/job_context.h"

namespace footwall::extract {

struct Outcome;
struct Setup;

// The shifts, in voxels along the normal, at which the options need probes, ascending and without 0; empty
// where neither contrast nor offset is asked for.
std::span<const int> probe_shifts(const Options& options);

// The triangle moved by `shift` voxels along its unit normal (by its winding), each component of the movement
// rounded to the lattice, ties to even; none for a triangle without area, or where it would leave the
// lattice.
std::optional<survey::LatticeTriangle> shifted(const survey::LatticeTriangle& triangle, int shift);

// Puts contrast and offset, along the winding's normal, into outcome.finished, whose discontinuities must be
// there. Collective; cancellable per face; does nothing where the options ask for neither.
void run_probes(const Setup& setup, const JobContext& job, Outcome& outcome);

// From the winding's normal to the fault's. faces: all of each fault, in any order; one statistic for each.
// The mean normal is weighted by area, and exact; where it is zero, the windings decide.
void orient_offsets(std::span<const Face> faces, std::span<FaceStatistics> statistics);

}  // namespace footwall::extract
