// From the faults of a project to faces as the engine knows them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/extract/face.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {

// What becomes of a mesh that had to be made because pillars changed since the last one.
enum class FreshMeshes : std::uint8_t { kStored, kThrownAway };

// Says which meshes were made, and which could not be.
struct MeshNotes {
  std::vector<std::string> triangulated;  // faults whose mesh was made first
  std::vector<std::string> skipped;       // faults that could not be made a surface, with the reason
};

// A mesh of the fault as it is now; nothing where it cannot be made a surface, which is noted, or thrown
// (kInvalid) where `required`. With kThrownAway the project is not written to.
std::optional<project::MeshRecord> fresh_mesh(project::Project& project, const project::FaultRecord& fault,
                                              bool required, FreshMeshes meshes, MeshNotes& notes,
                                              const JobContext& job);

// The mesh's faces on the lattice of a survey; `origin` voxels are taken off for a volume that starts there.
// Throws Error naming fault and vertex for one that lies beyond the lattice.
std::vector<extract::Face> fault_faces(const project::FaultRecord& fault, const project::MeshRecord& mesh,
                                       const survey::Lattice& lattice, const survey::Index& origin);

}  // namespace footwall::tasks
