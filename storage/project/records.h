// The rows of a project as plain values. Ids are given by the project and never used twice, also not after
// undo.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/survey/pillar.h"
#include "storage/survey/points.h"
#include "storage/survey/surface.h"

namespace footwall::project {

using Bytes = std::vector<std::byte>;

// A volume on disk, as `info` lists it. Statistics are over the non-null samples; NaN where there is none.
struct VolumeRecord {
  std::int64_t id = 0;
  std::string name;                      // unique in the project
  std::string file;                      // relative to Project::volumes_folder(); see Project::volume_path()
  std::array<std::int64_t, 3> dims{};    // inlines, crosslines, samples
  std::array<std::int64_t, 3> origin{};  // index of its first voxel in the survey
  std::int64_t bytes = 0;                // of the file
  std::string checksum;                  // 16 hexadecimal digits, of the file's table of chunk hashes
  double min = 0, max = 0, mean = 0, stddev = 0, max_abs = 0;
  std::int64_t null_count = 0;
  std::int64_t live_traces = 0;
  std::optional<double> null_value;
  std::string role = "amplitude";  // amplitude, discontinuity, other
  std::string source;              // where it came from, in words
  std::string provenance = "{}";   // JSON: how it was made
};

// A volume whose file is not where the project says, or is not that file.
struct MissingFile {
  std::string volume;
  std::filesystem::path path;  // where it should be
  std::string reason;          // "not there", "has 10 bytes, expected 20"
};

struct FaultRecord {
  std::int64_t id = 0;
  std::string name;  // unique among the faults
  std::string colour = "#d62728";
  std::string interpreter;
  std::string status = "draft";
  std::string note;
  std::string modified;       // UTC, e.g. 2024-05-31T12:00:00Z
  std::int64_t revision = 0;  // of the shape (pillars, chart, tie tolerance): a new number with every change,
                              // the old number again after undo; a mesh made from this revision is fresh
  bool locked = false;        // edits are refused until it is unlocked
  double tie_tolerance = 2.0;  // voxels
  Bytes chart;                 // as engine/pillars packs it; empty until set by Interpretation::set_chart
};

// Of a surface's coordinates: "m" or "ft"; "ms", "s", "m" or "ft".
struct SurfaceUnits {
  std::string horizontal = "m";
  std::string vertical = "m";
  friend bool operator==(const SurfaceUnits&, const SurfaceUnits&) = default;
};

// An imported surface: interpretation too. Its z is positive down.
struct SurfaceRecord {
  std::int64_t id = 0;
  std::string name;        // unique among the surfaces
  std::string kind;        // e.g. "gocad_tsurf"
  std::int64_t fault = 0;  // the fault whose mesh it is, one without pillars; 0 = none
  SurfaceUnits units;
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
};

struct HistoryStep {
  std::int64_t id = 0;
  std::string name;
  std::string when;      // UTC
  bool undone = false;   // redo would bring it back
  bool barrier = false;  // "history ends here": written by a migration, cannot be undone
};

struct HistorySize {
  std::int64_t steps = 0;
  std::int64_t bytes = 0;
};

struct EditResult {
  bool changed = false;                   // false: nothing differed, so nothing was recorded
  std::int64_t step = 0;                  // HistoryStep::id, 0 without change
  std::vector<std::int64_t> faults;       // whose shape got a new revision, ascending
  std::vector<std::int64_t> regenerated;  // interpolated pillars that followed a parent
  std::vector<std::int64_t> removed;      // interpolated pillars that went with a deleted parent
};

// One triangulation of one fault; derived, outside undo.
struct MeshVertex {
  enum class Owner : std::uint8_t { kPillar, kPanel };
  Owner kind = Owner::kPillar;
  std::int64_t owner = 0;  // pillar or panel id
  std::int32_t n = 0;      // number within its owner
  survey::WorldPoint position;
  friend bool operator==(const MeshVertex&, const MeshVertex&) = default;
};
struct MeshFace {
  std::int64_t panel = 0;
  std::int32_t n = 0;                      // number within the panel
  std::array<std::int32_t, 3> vertices{};  // indices into MeshRecord::vertices
  friend bool operator==(const MeshFace&, const MeshFace&) = default;
};
struct MeshRecord {
  std::int64_t revision = 0;      // FaultRecord::revision of the pillars it was made from
  std::string algorithm;          // name and version
  std::string parameters = "{}";  // JSON
  Bytes chart;                    // the chart it was made in; hand it on at the next triangulation
  std::vector<MeshVertex> vertices;
  std::vector<MeshFace> faces;
  friend bool operator==(const MeshRecord&, const MeshRecord&) = default;
};

// What is known about a statistic: CSV, VTP, inspector and colour list enumerate these rows.
struct StatisticRecord {
  std::string name;
  std::int32_t version = 1;
  std::string unit_rule;      // e.g. "1", "amplitude", "amplitude^2", "degrees", "horizontal^2"
  std::optional<double> low;  // the range colours start with; unset = from the data
  std::optional<double> high;
  std::string colour_map = "viridis";
  std::string description;
  friend bool operator==(const StatisticRecord&, const StatisticRecord&) = default;
};

// One EXTRACT-ALL.
struct RunRecord {
  std::int64_t id = 0;
  std::string name;    // empty: "run <id>"
  bool live = false;   // live results: a new live run of the same volume replaces the former one
  std::string volume;  // VolumeRecord::name
  std::string volume_checksum;
  std::string parameters = "{}";  // JSON: strategy, ranks, statistics ...
  std::string result = "{}";      // JSON: seconds, bytes, checksum ...
  std::string when;               // UTC, given by the project
};

// The voxel values of a fault's faces, as a computation of the run kept them.
struct FaceVoxels {
  std::string codec;  // what made the bytes, e.g. "lot", "voxels": a name of extract/computations.h
  std::string parameters = "{}";    // JSON: what it takes to read them back
  std::vector<std::uint64_t> ends;  // one per face: where its bytes end in `bytes`
  Bytes bytes;
};

// The part of a run that belongs to one fault; every vector has one entry per face, in the same order.
struct FaultRun {
  std::int64_t fault = 0;
  std::string fault_name;     // at the time of the run
  std::int64_t revision = 0;  // MeshRecord::revision
  std::vector<std::int64_t> panels;
  std::vector<std::int32_t> numbers;                      // face id = (panels[f], numbers[f])
  std::vector<survey::LatticeTriangle> lattice;           // the positions that were voxelized
  std::map<std::string, std::vector<double>> statistics;  // NaN = undefined
  std::vector<FaceVoxels> voxels;  // for add_run; read by Project::face_voxels alone, since they may be large
};

// A camera under a name. Not interpretation: outside undo.
struct ViewRecord {
  std::string name;
  std::string camera;  // "azimuth,elevation,zoom" or "eye;target;up", as `footwall render --camera` takes it
  double exaggeration = 0;  // of heights; 0 = chosen to suit the box
  std::string when;         // UTC, given by the project
};

struct IntegrityReport {
  std::vector<std::string> problems;  // one line each; empty = whole
  bool ok() const { return problems.empty(); }
};

}  // namespace footwall::project
