// The model that every rank holds whole: faces by name, and the meshes behind those that mesh operations
// made. The same batches in the same order give the same faces, ids and refusals on every rank.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "engine/extract/face_changes.h"
#include "engine/mesh/model.h"

namespace footwall::v1 {
class Edit;
class EditBatch;
}  // namespace footwall::v1

namespace footwall::service {

class FaceModel {
 public:
  using Faces = std::map<extract::FaceIdentity, survey::LatticeTriangle>;

  // What a batch did, and what was there before.
  class Change {
   public:
    // What mesh operations made, in their order.
    const std::vector<mesh::Applied>& made() const { return made_; }
    // The faces that are not as they were, in any order; some may stand here twice, or be as they were.
    std::vector<extract::FaceIdentity> names() const;

   private:
    friend class FaceModel;
    struct Replaced {
      extract::FaceIdentity name;
      std::optional<survey::LatticeTriangle> before;
    };
    struct Made {};  // the newest mesh was made
    struct Changed {
      mesh::MeshId id;
      mesh::Mesh before;
    };
    struct Cleared {
      mesh::MeshSet before;
    };
    using MeshUndo = std::variant<mesh::MoveVertex, Made, Changed, Cleared>;
    std::vector<mesh::Applied> made_;
    std::vector<Replaced> replaced_;  // oldest first
    std::vector<MeshUndo> meshes_;    // oldest first
    std::uint64_t edit_before_ = 0;
  };

  // All edits of the batch in their order, or none: throws Error kInvalid that names the face or mesh, and
  // the edit number where it is not newer than edit(); 0 stands for the next one. A position of -2^23 voxels
  // is refused, as by survey::Lattice. Takes time in proportion to the batch, but a mesh operation other than
  // MOVE-VERTEX also copies its mesh. Not collective.
  Change apply(const v1::EditBatch& batch);
  // Takes back the newest change that was not taken back.
  void undo(Change change);

  const Faces& faces() const { return faces_; }
  std::uint64_t edit() const { return edit_; }  // of the newest batch; 0 before the first
  // Of faces, mesh ids and edit(), whatever the order in which they came.
  std::uint64_t hash() const;

 private:
  void apply(const v1::Edit& edit, Change& change);
  void apply(const mesh::Operation& operation, Change& change);
  void set(const extract::FaceIdentity& name, const std::optional<survey::LatticeTriangle>& now,
           Change& change);
  void set(const extract::FaceIdentity& name, const std::optional<survey::LatticeTriangle>& now);
  void take_mesh_changes(Change& change);

  Faces faces_;
  std::uint64_t sum_ = 0;  // of the faces' hashes
  std::uint64_t edit_ = 0;
  mesh::MeshSet meshes_;
};

}  // namespace footwall::service
