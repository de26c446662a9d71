#include "engine/extract/model/shared_model.h"

namespace footwall::extract {
namespace {

Face face_of(const mesh::MeshSet& meshes, const mesh::FaceKey& key) {
  return {key.mesh, 0, key.face, meshes.triangle(key)};
}

std::vector<Face> faces_of(const mesh::MeshSet& meshes, const std::vector<mesh::FaceKey>& keys) {
  std::vector<Face> faces;
  faces.reserve(keys.size());
  for (const mesh::FaceKey& key : keys) faces.push_back(face_of(meshes, key));
  return faces;
}

}  // namespace

SharedModel::Outcome SharedModel::apply(const std::vector<mesh::Operation>& operations) {
  Outcome outcome;
  std::vector<mesh::Operation> received;
  if (world_.size() > 1) {
    const comm::Bytes bytes =
        world_.broadcast(world_.rank() == 0 ? mesh::encode(operations) : comm::Bytes{}, 0);
    if (world_.rank() != 0) received = mesh::decode(bytes);
  }
  const std::vector<mesh::Operation>& everywhere = world_.rank() == 0 ? operations : received;
  outcome.applied.resize(everywhere.size());
  for (std::size_t n = 0; n < everywhere.size(); ++n) {
    try {
      outcome.applied[n] = meshes_.apply(everywhere[n]);
    } catch (const Error& error) {
      outcome.refusals.push_back({n, error});
    }
  }
  return outcome;
}

std::vector<Face> SharedModel::faces() const {
  return faces_of(meshes_, meshes_.faces());
}

FaceChanges SharedModel::take_changes() {
  const mesh::Changes changes = meshes_.take_changes();
  FaceChanges faces{faces_of(meshes_, changes.added), faces_of(meshes_, changes.changed), {}};
  faces.removed.reserve(changes.removed.size());
  for (const mesh::FaceKey& key : changes.removed) faces.removed.push_back({key.mesh, 0, key.face});
  return faces;
}

}  // namespace footwall::extract
