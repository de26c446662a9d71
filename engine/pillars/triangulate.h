// Pillars to a triangle mesh: manifold, consistently oriented, a height field over the fault's chart (so that
// it cannot cut itself), local in every respect.
//
// The chart is divided by the pillars, and by straight closing edges from end to end of neighbours, into
// panels: the strip between two neighbouring pillars, or, where pillars cross, a cell of their arrangement.
// Each panel is filled by a constrained Delaunay triangulation that depends on its bounding pillars and the
// options alone. Based on: Garland and Heckbert, fast polygonal approximation of terrains and height
// fields, 1995 (greedy refinement until the vertical error is below a bound); Floater, mean value
// coordinates, 2003 (the surface inside a cell).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/pillars/chart.h"
#include "engine/pillars/place_text.h"
#include "storage/base/job_context.h"
#include "storage/survey/points.h"

namespace footwall::pillars {

// All lengths in voxels of index space.
struct Options {
  // Largest height difference to the ruled surface between a panel's pillars at equal normalised length
  // (inside a cell: to the mean value interpolation of its rim; none where a pillar ends inside the panel).
  double detail = 0.5;
  double max_edge = 16;      // longest edge
  double tie_tolerance = 2;  // crossing pillars at most this far apart are tied half-way
  PlaceText place_text = index_text;
};

struct MeshVertex {
  enum class Kind : std::uint8_t { kPillar, kPanel };
  Kind kind = Kind::kPillar;
  // (kind, owner, n) is unique and stable. A pillar's points are counted from its end nearest the chart's
  // start, whatever order it was picked in; a tie or closing edge is owned by the pair of its pillars, as a
  // panel is; ties count down from -1, all others up from 0.
  std::int64_t owner = 0;
  std::int32_t n = 0;
  survey::IndexPoint position;
  // The pillar node whose position this is, exactly: its id, or its number in the pillar where no ids were
  // given; -1 for a point between nodes, and for a tie.
  std::int64_t node_id = -1;
};

struct MeshFace {
  std::int64_t panel = 0;
  std::int32_t n = 0;
  std::array<std::int32_t, 3> vertices{0, 0,
                                       0};  // into FaultMesh::vertices, counter-clockwise about the normal
};

struct Panel {
  std::int64_t id = 0;
  std::vector<std::int64_t> pillars;  // that bound it or end in it, ascending
  bool strip = false;                 // between two neighbouring pillars, otherwise a cell
};

struct MisTie {
  std::int64_t pillar_a = 0;  // < pillar_b
  std::int64_t pillar_b = 0;
  double distance = 0;          // in voxels, along the chart's normal
  survey::IndexPoint position;  // of the tie, half-way
};

struct FaultMesh {
  std::vector<MeshVertex> vertices;
  std::vector<MeshFace> faces;  // by panel, then n
  std::vector<Panel> panels;    // by id
  Chart chart;                  // to be stored and given back next time
  std::vector<MisTie> mis_ties;
  std::vector<std::string> notes;  // for the user: reversed pillars, dropped duplicate nodes, ...
};

// The id of what two pillars bound: (smaller id) * 2^31 + (larger id) where both are below 2^31, otherwise,
// and for cells, a negative hash.
std::int64_t pair_id(std::int64_t pillar_a, std::int64_t pillar_b);

// chart: the one stored with the fault; nothing, or an empty one, to find it (first triangulation,
// --rechart). Faces wind so that at the first triangulation the mean normal has a positive first component
// that is not zero. Three pillars or more that cannot be made a surface in that chart are tried in one fitted
// anew, then in fit_chart_across(); the mesh has the chart that served. The order of `pillars` does not
// matter. A pillar of one node makes a fan at the fault's end, or a point inside a panel. Deterministic: the
// same bits for the same input on every machine; one thread. Throws Error kInvalid naming the pillars: fewer
// than two, none with nodes, not finite, all on one line, pillars on top of each other, crossing beyond the
// tolerance, folded in the chart, two parts joined in a single point; kUsage for options that are not
// positive; kMemory above 5 million vertices; kCancelled.
FaultMesh triangulate(std::span<const PillarInput> pillars, const Options& options,
                      const std::optional<Chart>& chart, const JobContext& job);

}  // namespace footwall::pillars
