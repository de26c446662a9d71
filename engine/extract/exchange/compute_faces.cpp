#include "engine/extract/exchange/compute_faces.h"

#include <algorithm>

#include "engine/extract/exchange/face_folder.h"
#include "engine/extract/face_order.h"
#include "engine/extract/parallel_faces.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"

namespace footwall::extract {
namespace {

// A thread's tools.
struct Worker {
  explicit Worker(const Setup& setup)
      : voxelizer(voxelize::make_voxelizer(setup.options.voxelizer)), folder(setup), values(setup) {
    for (const Computation* each : setup.whole_face) computations.push_back(each->make(setup.options));
  }
  std::unique_ptr<voxelize::Voxelizer> voxelizer;
  FaceFolder folder;
  FaceValues values;
  FaceRows rows;
  std::vector<std::unique_ptr<WholeFace>> computations;
  std::int64_t walked = 0;
};

// The boxes that hold all values around the voxels inside them.
std::vector<survey::Box> full_boxes(const Setup& setup) {
  std::vector<survey::Box> boxes;
  for (const Block& block : setup.blocks.all()) {
    boxes.push_back(setup.reach() > 0 ? block.own() : block.wanted());
  }
  return boxes;
}

}  // namespace

OwnFaces own_faces(const Setup& setup) {
  OwnFaces faces;
  const std::vector<survey::Box> boxes = full_boxes(setup);
  const survey::Box survey{{0, 0, 0}, setup.input.dims};
  FaceOrder order;
  order.of(setup.input.faces);
  for (std::size_t at = 0; at < order.size(); ++at) {
    const std::size_t n = order[at];
    if (!setup.mine(n)) continue;
    const survey::Box around =
        survey::intersection(voxelize::bounding_voxels(setup.face(n).triangle), survey);
    const bool local = around.empty() || std::any_of(boxes.begin(), boxes.end(), [&](const survey::Box& box) {
                         return survey::intersection(around, box) == around;
                       });
    (local ? faces.local : faces.crossing).push_back(n);
  }
  return faces;
}

void compute_faces(const Setup& setup, std::span<const std::size_t> faces, Outcome& outcome,
                   const std::function<void()>& between) {
  if (faces.empty()) return;
  const survey::Box survey{{0, 0, 0}, setup.input.dims};
  std::vector<std::unique_ptr<Worker>> workers(
      std::min(static_cast<std::size_t>(setup.threads), faces.size()));
  for (auto& worker : workers) worker = std::make_unique<Worker>(setup);
  const std::size_t finished_before = outcome.finished.size();
  const std::size_t blobs_before = outcome.blobs.size();
  const std::size_t computations = setup.whole_face.size();
  outcome.finished.resize(finished_before + faces.size());
  outcome.blobs.resize(blobs_before + faces.size() * computations);

  parallel_faces(faces.size(), static_cast<int>(workers.size()), setup.job, "compute",
                 [&](std::size_t thread, std::size_t n) {
                   Worker& worker = *workers[thread];
                   const Face& face = setup.face(faces[n]);
                   Partial partial;
                   if (computations == 0) {
                     worker.voxelizer->rows(face.triangle, survey, worker.folder);
                     partial = worker.folder.take();
                   } else {
                     worker.rows.clear();
                     worker.voxelizer->rows(face.triangle, survey, worker.rows);
                     const std::span<const float> values = worker.values.of(worker.rows);
                     if (setup.with_discontinuity) {
                       for (std::size_t r = 0; r < worker.rows.rows(); ++r)
                         worker.folder.row(worker.rows.at(r));
                       partial = worker.folder.take();
                     } else {
                       fold(values, partial.moments);
                     }
                     for (std::size_t c = 0; c < computations; ++c) {
                       FinishedBlob& blob = outcome.blobs[blobs_before + n * computations + c];
                       blob.face = static_cast<std::int64_t>(faces[n]);
                       blob.computation = c;
                       worker.computations[c]->compute({face, worker.rows, values}, blob.bytes);
                     }
                   }
                   outcome.finished[finished_before + n] = {
                       static_cast<std::int64_t>(faces[n]),
                       finish(partial, inside(face.triangle, setup.input.dims))};
                   worker.walked += partial.voxels();
                   if (between && thread == 0) between();
                 });
  for (const auto& worker : workers) outcome.walked += worker->walked;
}

}  // namespace footwall::extract
