// `footwall bench topology`: whether the case tables give the surfaces that small trilinear fields have.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "storage/base/job_context.h"

namespace footwall::tasks {

struct BenchTopologyOptions {
  // A heading and rows of fields between commas; '#' starts a comment. The heading names the columns: `id`;
  // v0..vN, each or as one range, the values of 2^3 or n^3 samples, x fastest, then y; what is expected:
  // `chi` (Euler number), `b0` (components), `genus` (of all components together: the surface is closed).
  std::filesystem::path csv;  // empty: none
  // Random cells that are compared with the sampled trilinear field (engine/verify/trilinear_level_set.h).
  std::int64_t cells = 0;
  std::uint64_t seed = 1;
  std::string tables = "trilinear";  // or seed000, seed002
  float isovalue = 0;
};

struct TopologyMismatch {
  std::string id;
  std::map<std::string, std::int64_t> expected;  // what differs, by name: euler, components, genus, ...
  std::map<std::string, std::int64_t> got;
};

struct BenchTopologyResult {
  std::int64_t rows = 0;
  std::int64_t triangles = 0;
  std::int64_t open_edges = 0;               // with one triangle, not on the border of the samples: cracks
  std::int64_t crowded_edges = 0;            // with more than two triangles
  std::vector<TopologyMismatch> mismatches;  // of the file
  std::int64_t cells = 0;
  std::int64_t cells_undecided = 0;  // the level passes through a saddle, or nearly
  std::int64_t cell_mismatches = 0;  // another Euler number than the field's
};

// The surface of every row is put together cell by cell and welded (engine/isosurface/grid_topology.h).
// Throws kUsage for tables that are not there and an isovalue that is not finite, kNotFound and kIo for the
// file, kFormat with the line for rows that are not as the heading says; kCancelled.
BenchTopologyResult bench_topology(const BenchTopologyOptions& options, const JobContext& job);

}  // namespace footwall::tasks
