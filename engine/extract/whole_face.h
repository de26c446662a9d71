// Computations that need all voxels of a face at once, on the face's responsible rank: lapped transform,
// filters, the voxels themselves. What can be folded from parts of a face is in statistics/ instead.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/extract/face.h"
#include "engine/extract/face_rows.h"

namespace footwall::extract {

// One face and its voxels inside the survey.
struct FaceVoxels {
  const Face& face;
  const FaceRows& rows;           // where they are, in canonical order
  std::span<const float> values;  // rows.voxels() of them in the same order; NaN = null
};

// One object per thread, used for face after face. The same face and values must give the same bytes on
// every rank, thread and processor.
class WholeFace {
 public:
  virtual ~WholeFace() = default;
  // Appends the face's result to `out`; may append nothing. May throw; stays usable.
  virtual void compute(const FaceVoxels& face, std::vector<std::byte>& out) = 0;
};

}  // namespace footwall::extract
