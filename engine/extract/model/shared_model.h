// The polygon model that every rank has whole, under operations that rank 0 gives.
// Based on: seed 004, section 3.1 (the global polygon model). An operation costs one broadcast; every rank
// applies it alike, so that ids, refusals and the faces touched need no further communication.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/face.h"
#include "engine/extract/face_changes.h"
#include "engine/mesh/model.h"
#include "storage/base/error.h"

namespace footwall::extract {

// A face of mesh m with id f is the Face (fault m, owner 0, n f).
class SharedModel {
 public:
  // `world` must outlive it. Not collective.
  explicit SharedModel(const comm::Communicator& world) : world_(world) {}

  // What became of a batch: what each operation made, all kNone where it was refused and changed nothing; and
  // the reasons of the refused ones, ascending.
  struct Refusal {
    std::size_t operation = 0;
    Error reason;
  };
  struct Outcome {
    std::vector<mesh::Applied> applied;
    std::vector<Refusal> refusals;
  };
  // Applies rank 0's operations in their order on every rank; a refused one does not keep the next ones from
  // being applied. The other ranks' argument is ignored. The outcome is the same on every rank. Collective:
  // one broadcast, nothing after it; memory that is lacking is an exception of the rank alone.
  Outcome apply(const std::vector<mesh::Operation>& operations);

  const mesh::MeshSet& meshes() const { return meshes_; }
  // All faces, ascending by identity. Not collective.
  std::vector<Face> faces() const;
  // The faces touched since the last call, in time proportional to their number. Not collective; calls must
  // stand at the same place between the operations on every rank.
  FaceChanges take_changes();

 private:
  const comm::Communicator& world_;
  mesh::MeshSet meshes_;
};

}  // namespace footwall::extract
