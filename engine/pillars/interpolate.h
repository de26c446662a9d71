// Pillars inserted between picked ones: their height over the fault's chart is that of the thin plate through
// all picked nodes. Based on: Duchon, splines minimizing rotation-invariant semi-norms, 1977.
// Differs in: the saddle system is reduced to a positive definite one on the null space of the
// affine part (Householder), and solved by own loops whose sums run in a fixed order, so that the same bits
// come out on every machine.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/pillars/chart.h"
#include "engine/pillars/place_text.h"
#include "storage/base/job_context.h"

namespace footwall::pillars {

struct InterpolateOptions {
  // Exactly one of the two. every_lines: neighbours at most this many lines apart, evenly spaced (inlines,
  // crosslines or samples, whichever sections both were picked on; otherwise inline or crossline index,
  // whichever changes more). tolerance: insert, by halving, where thin plate and straight line between
  // neighbours differ by more than this many voxels.
  std::optional<double> every_lines = std::nullopt;
  std::optional<double> tolerance = std::nullopt;
  double smoothing = 0;       // mu of the thin plate, >= 0; 0 passes through every node
  double dip_anisotropy = 2;  // distances down the dip count this much more than along strike
  PlaceText place_text = index_text;
};

struct Parents {
  std::int64_t a = 0;
  std::int64_t b = 0;
  double parameter = 0;  // 0 at a, 1 at b
};

struct InterpolatedPillar {
  Parents parents;
  // As many as the parent with more nodes has, at equal normalised length along both; index space.
  std::vector<survey::IndexPoint> nodes;
};

struct Interpolation {
  std::vector<InterpolatedPillar> pillars;  // in the order along the fault
  std::vector<std::string> notes;  // thinned nodes, limited heights, pillars left alone because they cross
};

inline constexpr std::size_t kThinPlatePoints = 2000;  // more picked nodes are thinned evenly, with a note
inline constexpr std::size_t kInsertedPillars = 100000;

// picked: interpreted (and snapped) pillars only, in any order. Never extrapolates: an inserted pillar lies
// between its parents, and its height at most one pillar spacing off the straight line between them. Pillars
// that cross the fault's main direction take part in the thin plate but get no neighbours inserted. Throws
// Error kUsage unless exactly one positive spacing is given; kInvalid for fewer than two pillars, nodes that
// are not finite or all on one line; kMemory above kInsertedPillars; kCancelled.
Interpolation interpolate(std::span<const PillarInput> picked, const InterpolateOptions& options,
                          const std::optional<Chart>& chart, const JobContext& job);

// The same pillars again after a parent moved: one for each of `parents`. Only smoothing and anisotropy are
// taken from the options. Throws also kNotFound naming a parent that is not among `picked`.
Interpolation regenerate(std::span<const PillarInput> picked, std::span<const Parents> parents,
                         const InterpolateOptions& options, const std::optional<Chart>& chart,
                         const JobContext& job);

}  // namespace footwall::pillars
