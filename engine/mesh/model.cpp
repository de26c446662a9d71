#include "engine/mesh/model.h"

#include <fmt/format.h>
#include <algorithm>

#include "engine/mesh/walk.h"
#include "storage/survey/lattice.h"

namespace footwall::mesh {
namespace {

using survey::IndexPoint;
using survey::Lattice;

const Lattice& lattice() {
  static const Lattice kLattice{survey::Geometry{}};  // rounding in index space needs no geometry
  return kLattice;
}

// Refuses what the lattice does not hold.
IndexPoint index_of(const LatticePoint& p) {
  const IndexPoint index = Lattice::index_of(p);
  lattice().from_index(index);
  return index;
}

}  // namespace

Applied MeshSet::apply(const Operation& operation) {
  try {
    return std::visit([&](const auto& each) { return run(each); }, operation);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInvalid) throw;
    const MeshId mesh = std::visit(
        [](const auto& each) {
          if constexpr (requires { each.mesh; }) {
            return each.mesh;
          } else {
            return kNone;
          }
        },
        operation);
    const std::string where = mesh == kNone ? "" : fmt::format(" on mesh {}", mesh);
    throw Error(error.code(), fmt::format("{}{} is refused: {}", name_of(operation), where, error.message()),
                error.hint());
  }
}

bool MeshSet::has_mesh(MeshId id) const {
  return id >= 0 && id < mesh_limit() && meshes_[id] != nullptr && meshes_[id]->alive;
}

const Mesh& MeshSet::mesh(MeshId id) const {
  if (!has_mesh(id)) throw Error(ErrorCode::kInvalid, fmt::format("there is no mesh {}", id));
  return meshes_[id]->mesh;
}

Mesh& MeshSet::writable(MeshId id) {
  mesh(id);
  return meshes_[id]->mesh;
}

survey::LatticeTriangle MeshSet::triangle(const FaceKey& key) const {
  const Mesh& in = mesh(key.mesh);
  const Face& face = in.face(key.face);
  survey::LatticeTriangle corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = lattice().from_index(in.position(face.vertices[k]));
  return corners;
}

std::vector<FaceKey> MeshSet::faces() const {
  std::vector<FaceKey> all;
  all.reserve(static_cast<std::size_t>(face_count_));
  for (MeshId m = 0; m < mesh_limit(); ++m) {
    if (!has_mesh(m)) continue;
    const Mesh& each = meshes_[m]->mesh;
    for (FaceId f = 0; f < each.face_limit(); ++f) {
      if (each.has_face(f)) all.push_back({m, f});
    }
  }
  return all;
}

Applied MeshSet::run(const CreateMesh& operation) {
  std::vector<IndexPoint> positions;
  positions.reserve(operation.positions.size());
  for (const LatticePoint& p : operation.positions) positions.push_back(index_of(p));
  if (operation.faces.empty())
    throw Error(ErrorCode::kInvalid, "a mesh has at least one face", "name its triangles");
  auto slot = std::make_unique<Slot>();
  slot->mesh = Mesh(positions, operation.faces);
  const MeshId id = mesh_limit();
  meshes_.push_back(std::move(slot));
  ++mesh_count_;
  for (FaceId f = 0; f < meshes_[id]->mesh.face_limit(); ++f) added(id, f);
  return {id, kNone, kNone, 0};
}

Applied MeshSet::run(const DestroyMesh& operation) {
  const Mesh& gone = mesh(operation.mesh);
  for (FaceId f = 0; f < gone.face_limit() && gone.face_count() > 0; ++f) {
    if (gone.has_face(f)) removed(operation.mesh, f);
  }
  // Its faces' touches are told at the next look; then it goes.
  meshes_[operation.mesh]->alive = false;
  meshes_[operation.mesh]->mesh = Mesh();
  destroyed_.push_back(operation.mesh);
  --mesh_count_;
  return {operation.mesh, kNone, kNone, kNone};
}

Applied MeshSet::run(const AddFace& operation) {
  Mesh& m = writable(operation.mesh);
  const auto* position = std::get_if<LatticePoint>(&operation.apex);
  const AddedFace made = position != nullptr
                             ? m.add_face(operation.border_edge, index_of(*position))
                             : m.add_face(operation.border_edge, std::get<VertexId>(operation.apex));
  added(operation.mesh, made.face);
  return {operation.mesh, made.vertex, kNone, made.face};
}

Applied MeshSet::run(const RemoveFaces& operation) {
  for (const FaceId f : writable(operation.mesh).remove_faces_around(operation.vertex))
    removed(operation.mesh, f);
  return {operation.mesh, kNone, kNone, kNone};
}

Applied MeshSet::run(const RemoveFace& operation) {
  writable(operation.mesh).remove_face(operation.face);
  removed(operation.mesh, operation.face);
  return {operation.mesh, kNone, kNone, kNone};
}

Applied MeshSet::run(const MoveVertex& operation) {
  Mesh& m = writable(operation.mesh);
  m.move_vertex(operation.vertex, index_of(operation.to));
  fan_.clear();
  append_faces_of(m, operation.vertex, fan_);
  for (const FaceId f : fan_) changed(operation.mesh, f);
  return {operation.mesh, kNone, kNone, kNone};
}

Applied MeshSet::run(const SplitEdge& operation) {
  Mesh& m = writable(operation.mesh);
  const IndexPoint at = index_of(operation.at);
  const std::array<FaceId, 2> beside = m.edge(operation.edge).faces;
  const EdgeSplit split = m.split_edge(operation.edge, at);
  for (const FaceId f : beside) {
    if (f != kNone) changed(operation.mesh, f);
  }
  for (const FaceId f : split.faces) {
    if (f != kNone) added(operation.mesh, f);
  }
  return {operation.mesh, split.vertex, split.edge, kNone};
}

MeshSet::Touch& MeshSet::touch(MeshId mesh, FaceId face) {
  auto& touches = meshes_[mesh]->touches;
  const auto at = static_cast<std::size_t>(face);
  if (touches.size() <= at) touches.resize(std::max(at + 1, 2 * touches.size()), Touch::kNot);
  if (touches[at] == Touch::kNot) touched_.push_back({mesh, face});
  return touches[at];
}

void MeshSet::added(MeshId mesh, FaceId face) {
  touch(mesh, face) = Touch::kAdded;  // ids are new
  ++face_count_;
}

void MeshSet::changed(MeshId mesh, FaceId face) {
  Touch& now = touch(mesh, face);
  if (now == Touch::kNot) now = Touch::kChanged;
}

void MeshSet::removed(MeshId mesh, FaceId face) {
  Touch& now = touch(mesh, face);
  now = now == Touch::kAdded ? Touch::kCameAndWent : Touch::kRemoved;
  --face_count_;
}

Changes MeshSet::take_changes() {
  std::sort(touched_.begin(), touched_.end());
  Changes changes;
  for (const FaceKey& key : touched_) {
    Touch& touch = meshes_[key.mesh]->touches[static_cast<std::size_t>(key.face)];
    if (touch == Touch::kAdded) changes.added.push_back(key);
    if (touch == Touch::kChanged) changes.changed.push_back(key);
    if (touch == Touch::kRemoved) changes.removed.push_back(key);
    touch = Touch::kNot;
  }
  touched_.clear();
  for (const MeshId id : destroyed_) meshes_[id].reset();
  destroyed_.clear();
  return changes;
}

void MeshSet::forget_newest() {
  require(touched_.empty() && has_mesh(mesh_limit() - 1), "the newest mesh, after take_changes()");
  face_count_ -= meshes_.back()->mesh.face_count();
  --mesh_count_;
  meshes_.pop_back();
}

void MeshSet::restore(MeshId id, Mesh mesh) {
  require(touched_.empty() && id >= 0 && id < mesh_limit(), "a mesh of before, after take_changes()");
  std::unique_ptr<Slot>& slot = meshes_[id];
  if (slot) {
    face_count_ -= slot->mesh.face_count();
  } else {
    slot = std::make_unique<Slot>();
    ++mesh_count_;
  }
  face_count_ += mesh.face_count();
  slot->mesh = std::move(mesh);
}

}  // namespace footwall::mesh
