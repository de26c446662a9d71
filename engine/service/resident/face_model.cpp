#include "engine/service/resident/face_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/service/engine.pb.h"
#include "engine/service/wire.h"
#include "storage/base/hash.h"

namespace footwall::service {
namespace {

using extract::Face;
using extract::FaceIdentity;
using survey::LatticePoint;
using survey::LatticeTriangle;

// Of one face. Summed over all, without order: so it follows changes one by one.
std::uint64_t hash_of(const FaceIdentity& name, const LatticeTriangle& triangle) {
  std::array<std::int64_t, 12> words{name.fault, name.owner, name.n};
  std::size_t at = 3;
  for (const LatticePoint& p : triangle) {
    for (const std::int32_t place : {p.i, p.j, p.k}) words[at++] = place;
  }
  return hash64(std::as_bytes(std::span(words)));
}

Error refused(const FaceIdentity& name, std::string_view why, std::string_view hint) {
  return {ErrorCode::kInvalid,
          fmt::format("face {} of fault {}, owner {}: {}", name.n, name.fault, name.owner, why),
          std::string(hint)};
}

void check(const Face& face) {
  const FaceIdentity name = extract::identity_of(face);
  if (face.fault < 0) {
    throw refused(name, "faults below 0 are meshes of mesh operations",
                  "give faults numbers from 0, or change the mesh by mesh operations");
  }
  // The lattice ends 2^23 voxels from the origin: of what 32 bits can hold, one number lies beyond.
  constexpr std::int32_t kBeyond = std::numeric_limits<std::int32_t>::min();
  for (const LatticePoint& p : face.triangle) {
    if (p.i != kBeyond && p.j != kBeyond && p.k != kBeyond) continue;
    throw refused(name, "a corner lies 2^23 voxels or more from the survey's origin",
                  "check the coordinates that it was made from");
  }
}

FaceIdentity name_of(mesh::MeshId mesh, mesh::FaceId face) {
  return {-1 - std::int64_t{mesh}, 0, face};
}

}  // namespace

std::vector<FaceIdentity> FaceModel::Change::names() const {
  std::vector<FaceIdentity> names;
  names.reserve(replaced_.size());
  for (const Replaced& each : replaced_) names.push_back(each.name);
  return names;
}

void FaceModel::set(const FaceIdentity& name, const std::optional<LatticeTriangle>& now) {
  const auto at = faces_.lower_bound(name);
  const bool there = at != faces_.end() && at->first == name;
  if (now) {
    // What can fail comes first.
    if (!there) faces_.emplace_hint(at, name, *now);
    sum_ += hash_of(name, *now);
  }
  if (!there) return;
  sum_ -= hash_of(name, at->second);
  if (now) {
    at->second = *now;
  } else {
    faces_.erase(at);
  }
}

void FaceModel::set(const FaceIdentity& name, const std::optional<LatticeTriangle>& now, Change& change) {
  const auto found = faces_.find(name);
  const std::optional<LatticeTriangle> before =
      found == faces_.end() ? std::nullopt : std::optional(found->second);
  if (before == now) return;
  change.replaced_.push_back({name, before});
  try {
    set(name, now);
  } catch (...) {
    change.replaced_.pop_back();
    throw;
  }
}

FaceModel::Change FaceModel::apply(const v1::EditBatch& batch) {
  Change change;
  change.edit_before_ = edit_;
  if (batch.edit() != 0 && batch.edit() <= edit_) {
    throw Error(ErrorCode::kInvalid, fmt::format("edit {} is not newer than edit {}", batch.edit(), edit_),
                "number edits upwards, or give 0 for the next number");
  }
  try {
    for (const v1::Edit& edit : batch.edits()) apply(edit, change);
  } catch (...) {
    undo(std::move(change));
    throw;
  }
  edit_ = batch.edit() != 0 ? batch.edit() : edit_ + 1;
  return change;
}

void FaceModel::apply(const v1::Edit& edit, Change& change) {
  switch (edit.what_case()) {
    case v1::Edit::kMesh: {
      const auto operations = mesh::decode(std::as_bytes(std::span(edit.mesh())));
      if (operations.size() != 1) {
        throw Error(ErrorCode::kInvalid, fmt::format("an edit holds {} mesh operations", operations.size()),
                    "give one operation for each edit of the batch");
      }
      apply(operations.front(), change);
      break;
    }
    case v1::Edit::kPut:
      for (const Face& face : faces_from(edit.put())) {
        check(face);
        set(extract::identity_of(face), face.triangle, change);
      }
      break;
    case v1::Edit::kRemove:
      for (const FaceIdentity& name : names_from(edit.remove())) {
        if (name.fault < 0) throw refused(name, "it belongs to a mesh", "remove it by a mesh operation");
        if (!faces_.contains(name)) throw refused(name, "there is no such face", "read the model again");
        set(name, std::nullopt, change);
      }
      break;
    case v1::Edit::kReplace: {
      const std::int64_t fault = edit.replace().fault();
      Faces now;
      for (const Face& face : faces_from(edit.replace().faces())) {
        check(face);
        const FaceIdentity name = extract::identity_of(face);
        if (face.fault != fault)
          throw refused(name, fmt::format("it is not of fault {}", fault), "replace one fault by each edit");
        if (!now.emplace(name, face.triangle).second)
          throw refused(name, "it stands twice in the fault", "give each face a number of its own");
      }
      if (fault < 0) {
        throw Error(ErrorCode::kInvalid, fmt::format("fault {} is a mesh of mesh operations", fault),
                    "change it by mesh operations");
      }
      constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
      std::vector<FaceIdentity> gone;
      for (auto at = faces_.lower_bound({fault, kLeast, std::numeric_limits<std::int32_t>::min()});
           at != faces_.end() && at->first.fault == fault; ++at) {
        if (!now.contains(at->first)) gone.push_back(at->first);
      }
      for (const FaceIdentity& name : gone) set(name, std::nullopt, change);
      for (const auto& [name, triangle] : now) set(name, triangle, change);
      break;
    }
    case v1::Edit::kClear:
      if (!edit.clear()) break;
      change.replaced_.reserve(change.replaced_.size() + faces_.size());
      change.meshes_.emplace_back(Change::Cleared{});
      for (const auto& [name, triangle] : faces_) change.replaced_.push_back({name, triangle});
      faces_.clear();
      sum_ = 0;
      std::swap(std::get<Change::Cleared>(change.meshes_.back()).before, meshes_);
      break;
    case v1::Edit::WHAT_NOT_SET:
      throw Error(ErrorCode::kInvalid, "an edit of the batch says nothing",
                  "leave it out; or it is of a newer client, which this engine does not know");
  }
}

void FaceModel::apply(const mesh::Operation& operation, Change& change) {
  const auto before = [&]() -> Change::MeshUndo {
    if (const auto* move = std::get_if<mesh::MoveVertex>(&operation)) {
      const auto index = meshes_.mesh(move->mesh).position(move->vertex);
      constexpr double kUnits = survey::kLatticePerVoxel;  // positions are on the lattice: exact
      return mesh::MoveVertex{
          move->mesh,
          move->vertex,
          {static_cast<std::int32_t>(index.i * kUnits), static_cast<std::int32_t>(index.j * kUnits),
           static_cast<std::int32_t>(index.k * kUnits)}};
    }
    if (std::holds_alternative<mesh::CreateMesh>(operation)) return Change::Made{};
    const mesh::MeshId id = std::visit(
        [](const auto& each) {
          if constexpr (requires { each.mesh; }) {
            return each.mesh;
          } else {
            return mesh::kNone;
          }
        },
        operation);
    return Change::Changed{id, meshes_.mesh(id)};
  };
  change.meshes_.push_back(before());
  try {
    change.made_.push_back(meshes_.apply(operation));
  } catch (...) {
    change.meshes_.pop_back();
    throw;
  }
  take_mesh_changes(change);
}

void FaceModel::take_mesh_changes(Change& change) {
  const mesh::Changes changes = meshes_.take_changes();
  for (const auto* keys : {&changes.added, &changes.changed}) {
    for (const mesh::FaceKey& key : *keys) set(name_of(key.mesh, key.face), meshes_.triangle(key), change);
  }
  for (const mesh::FaceKey& key : changes.removed) set(name_of(key.mesh, key.face), std::nullopt, change);
}

void FaceModel::undo(Change change) {
  for (auto at = change.replaced_.rbegin(); at != change.replaced_.rend(); ++at) set(at->name, at->before);
  for (auto at = change.meshes_.rbegin(); at != change.meshes_.rend(); ++at) {
    if (const auto* move = std::get_if<mesh::MoveVertex>(&*at)) {
      meshes_.apply(*move);
    } else if (std::holds_alternative<Change::Made>(*at)) {
      meshes_.take_changes();
      meshes_.forget_newest();
    } else if (auto* changed = std::get_if<Change::Changed>(&*at)) {
      meshes_.take_changes();
      meshes_.restore(changed->id, std::move(changed->before));
    } else {
      meshes_ = std::move(std::get<Change::Cleared>(*at).before);
    }
  }
  meshes_.take_changes();
  edit_ = change.edit_before_;
}

std::uint64_t FaceModel::hash() const {
  const std::array<std::uint64_t, 4> words{sum_, faces_.size(), edit_,
                                           static_cast<std::uint64_t>(meshes_.mesh_limit())};
  return hash64(std::as_bytes(std::span(words)));
}

}  // namespace footwall::service
