// What EXTRACT-ALL can compute, by name. A new computation is one file and one row here: either it folds (an
// exact fold, merge and finish in statistics/; any exchange strategy will do), or it is given a face's voxels
// (whole_face.h; the exchange must move voxels: not `reduce`).
#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "engine/extract/face.h"
#include "engine/extract/whole_face.h"

namespace footwall::extract {

struct Computation {
  std::string_view name;
  std::string_view help;
  std::string_view unit_rule;  // "1", "amplitude", "amplitude^2", "bytes": see tasks/statistics.h
  bool built;
  bool by_default;  // computed where Options::compute is empty; usual_computations()
                    // (registry.h) adds contrast
  int halo;         // traces around a voxel that it looks at: 0 or 1
  // Null for one that folds. Throws kUsage for options that it cannot work with.
  std::unique_ptr<WholeFace> (*make)(const Options& options);
  // Of one that does not fold: its bytes are a value of each voxel of the face, as VoxelReader (lot.h) reads
  // them. The project keeps them with the run, and they can be exported; other bytes end in the part files.
  bool holds_voxels = false;
};

// In the order in which help lists them. Of several that hold voxels the first one is what an export writes.
std::span<const Computation> computations();
// Throws kUsage, listing the names, where there is none or it is not built.
const Computation& computation(std::string_view name);
// Whether the options ask for `name`; an empty list asks for those by default.
bool asks_for(const Options& options, std::string_view name);
// The rows that the options ask for and that need a face's voxels.
std::vector<const Computation*> whole_face_computations(const Options& options);

}  // namespace footwall::extract
