// The faces of faults with the statistics of a run, for CSV, VTP, TSurf, pictures and rankings.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "storage/formats/mesh_table.h"
#include "storage/project/project.h"

namespace footwall::tasks {

enum class Coordinates : std::uint8_t {
  kWorld,  // as picked, in the survey's CRS and vertical unit
  kIndex   // the lattice positions that were voxelized, in voxels: i as x, j as y, k as z
};

struct FaceTables {
  std::vector<formats::MeshTable> tables;
  std::optional<project::RunRecord> run;  // none: no run yet, and so no statistics
  std::vector<std::string> stale;         // faults edited since the run: their faces are those of the run
  project::SurfaceUnits
      units;        // of world coordinates: the survey's, else the imported surfaces'; z as asked for
  std::string crs;  // the survey's
};

// The run that is meant where none is named: the last that was set by hand for `statistic` (where one was),
// else the last that was computed; where nothing was computed and no statistic is asked for, the last.
// Throws kNotFound for a run that is not there.
std::optional<project::RunRecord> chosen_run(const project::Project& project, std::optional<std::int64_t> run,
                                             const std::string& statistic = {});

// fault: empty for all. run: none for the one that chosen_run() finds. Faults of a run that are no longer in
// the project are left out. Without any run the present meshes come without statistics. World coordinates
// need no survey. An imported surface comes with the vertices of its file, not with those at which it was
// cut. Throws kNotFound for names and runs that are not there, kUsage for a z_unit of the other domain
// (empty: as stored), kInvalid where surfaces without a survey are in different units.
FaceTables face_tables(const project::Project& project, const std::string& fault,
                       std::optional<std::int64_t> run, Coordinates coordinates,
                       const std::string& z_unit = {});

// The present meshes, whatever runs there are, without statistics.
FaceTables present_faces(const project::Project& project, const std::string& fault, Coordinates coordinates,
                         const std::string& z_unit = {});

// The name of a face: "3-7.12" is face 12 of the strip between pillars 3 and 7 (pillars::pair_id); "cell
// 8f2e....12" in a tied network; "1.12" in the first piece of an imported surface.
std::string face_id(std::int64_t panel, std::int32_t n);

// Faces with at least `least_count` samples (where the run has counts) and a defined value, by rising (or
// falling) value; ties by order.
struct RankedFace {
  std::size_t table = 0;
  std::size_t face = 0;
  double value = 0;
};
std::vector<RankedFace> ranked_faces(const FaceTables& faces, const std::string& statistic, bool lowest_first,
                                     std::size_t most, double least_count = 30);
// The number of samples of each face; empty where the run has none: it was set by hand.
std::vector<double> counts_of(const formats::MeshTable& table);
// The values of a statistic in a table; throws kUsage listing the names where it is not there.
const std::vector<double>& values_of(const formats::MeshTable& table, const std::string& statistic);

}  // namespace footwall::tasks
