// The statistics of whole faults over distinct voxels: a voxel that several faces of a fault cut counts once.
// Every rank marks the voxels of its own part in a bitmap, folds each marked one once, and the exact partial
// sums are merged: the same numbers for any rank count, thread count and order of faces.
#pragma once
#include <span>
#include <vector>

#include "engine/extract/face.h"
#include "engine/extract/statistics/partial.h"

namespace footwall::extract {

struct Setup;

// Over the union of VOXELIZE(face) of a fault's faces, inside the survey.
struct FaultStatistics {
  std::int64_t fault = 0;
  std::int64_t faces = 0;
  // outside: kInside where all faces are, kWholly where none touches the survey; contrast and offset of a
  // whole fault are not defined.
  FaceStatistics statistics;
};

// Of every fault of setup.input.faces, ascending by id, on rank 0; empty elsewhere. Memory: one bit for each
// voxel of the part of the rank's blocks that a fault's bounding box covers. Collective; cancellable per
// face.
std::vector<FaultStatistics> fault_statistics(const Setup& setup);

}  // namespace footwall::extract
