// Pillars to meshes, stored in the project; and new pillars between picked ones.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct TriangulateOptions {
  double detail = 0.5;   // voxels
  double max_edge = 16;  // voxels
  double tie = 2;        // voxels: pillars that cross within it are tied
  bool rechart = false;  // fit the chart anew instead of keeping the stored one
};

struct Triangulated {
  std::string fault;
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  std::vector<std::string> notes;  // mis-ties, reversed pillars
};

// Triangulates one fault, whatever its state; one that is an imported surface gets that surface's triangles,
// cut where they are not manifold. Throws kInvalid without a survey, or naming the pillars that cannot be
// made a surface.
Triangulated triangulate_fault(project::Project& project, const project::FaultRecord& fault,
                               const TriangulateOptions& options, const JobContext& job);

// The same without storing it: the mesh that triangulate_fault would store.
project::MeshRecord mesh_of_fault(const project::Project& project, const project::FaultRecord& fault,
                                  const TriangulateOptions& options, const JobContext& job,
                                  std::vector<std::string>* notes = nullptr);

// The same from pillars that need not be stored; reads no project, so that it may run on any thread. chart:
// the fault's own, or of its last mesh; empty: found anew. The mesh has the fault's revision. What is
// thrown does not name the fault.
project::MeshRecord mesh_of_pillars(const survey::Geometry& survey, const project::FaultRecord& fault,
                                    std::span<const survey::Pillar> pillars, const project::Bytes& chart,
                                    const TriangulateOptions& options, const JobContext& job,
                                    std::vector<std::string>* notes = nullptr);

struct InterpolateOptions {
  std::optional<double> every;      // lines between pillars
  std::optional<double> tolerance;  // voxels between the thin plate and straight lines; one of the two
};

// Inserts interpolated pillars as one edit; former interpolated ones are replaced. Returns how many there
// are.
std::int64_t interpolate_fault(project::Project& project, const project::FaultRecord& fault,
                               const InterpolateOptions& options, const JobContext& job);

// Takes a fault's interpolated pillars away again, as one edit. Returns how many there were.
std::int64_t remove_interpolated(project::Project& project, const project::FaultRecord& fault);

// Makes interpolated pillars follow the thin plate when a parent moves; call it on every project opened for
// writing.
void follow_parents(project::Project& project);

// The faults asked for: one by name, all for an empty name. Throws kNotFound where there is none.
std::vector<project::FaultRecord> chosen_faults(const project::Project& project, const std::string& name);
// The survey; throws kInvalid, saying what needs it, for a project without one.
survey::Geometry required_survey(const project::Project& project, std::string_view what);

}  // namespace footwall::tasks
