// A set of meshes under operations: the polygon model that every rank has whole (seed 004, section 3.1).
// The same operations in the same order give the same ids and the same refusals everywhere, so that nothing
// has to be agreed upon.
#pragma once
#include <compare>
#include <memory>
#include <optional>

#include "engine/mesh/operation.h"
#include "storage/base/error.h"

namespace footwall::mesh {

struct FaceKey {
  MeshId mesh = kNone;
  FaceId face = kNone;
  friend auto operator<=>(const FaceKey&, const FaceKey&) = default;
};

// What an operation made, kNone where it made none of the kind.
struct Applied {
  MeshId mesh = kNone;      // the mesh that was made or changed
  VertexId vertex = kNone;  // ADD-FACE: the face's vertex off the edge; SPLIT-EDGE: the new one
  EdgeId edge = kNone;      // SPLIT-EDGE: the new half of the edge
  FaceId face = kNone;      // ADD-FACE: the new face; CREATE-MESH: 0
  friend bool operator==(const Applied&, const Applied&) = default;
};

// The faces that are not what they were, each in one list, ascending by mesh and face. A face that came and
// went in between is in none.
struct Changes {
  std::vector<FaceKey> added;
  std::vector<FaceKey> changed;  // other corners, the same id
  std::vector<FaceKey> removed;
  bool empty() const { return added.empty() && changed.empty() && removed.empty(); }
  friend bool operator==(const Changes&, const Changes&) = default;
};

// Mesh ids are counted up from 0 and never used again. Not thread-safe while it changes.
class MeshSet {
 public:
  // Throws Error kInvalid, naming the mesh, for what the mesh refuses (mesh.h), a mesh that is not there and
  // a position of 2^23 voxels or more; nothing has changed then, and no id is taken.
  Applied apply(const Operation& operation);

  bool has_mesh(MeshId id) const;
  // One more than the largest id ever given.
  MeshId mesh_limit() const { return static_cast<MeshId>(meshes_.size()); }
  std::int32_t mesh_count() const { return mesh_count_; }
  std::int64_t face_count() const { return face_count_; }
  // Throws Error kInvalid for a mesh that is not there.
  const Mesh& mesh(MeshId id) const;
  // The corners of a face; throws Error kInvalid for one that is not there.
  survey::LatticeTriangle triangle(const FaceKey& face) const;
  // All faces, ascending by mesh and face.
  std::vector<FaceKey> faces() const;

  // The faces touched since the last call. Takes time in proportion to the faces touched (and their sorting),
  // not to the model.
  Changes take_changes();

  // To take operations back, newest first. Both want take_changes() to have been called since the last
  // operation, and touch no face in its sense. CREATE-MESH: the newest mesh was never there, and its id is
  // free again.
  void forget_newest();
  // Any other: the mesh as it was before, also where it was destroyed.
  void restore(MeshId id, Mesh mesh);

 private:
  enum class Touch : std::uint8_t { kNot, kAdded, kChanged, kRemoved, kCameAndWent };
  struct Slot {
    Mesh mesh;
    std::vector<Touch> touches;  // by face id, as long as there are faces since the last look
    bool alive = true;
  };

  Applied run(const CreateMesh& operation);
  Applied run(const DestroyMesh& operation);
  Applied run(const AddFace& operation);
  Applied run(const RemoveFaces& operation);
  Applied run(const RemoveFace& operation);
  Applied run(const MoveVertex& operation);
  Applied run(const SplitEdge& operation);

  Mesh& writable(MeshId id);
  void added(MeshId mesh, FaceId face);
  void changed(MeshId mesh, FaceId face);
  void removed(MeshId mesh, FaceId face);
  Touch& touch(MeshId mesh, FaceId face);

  std::vector<std::unique_ptr<Slot>> meshes_;  // by id; empty once destroyed and reported
  std::vector<FaceKey> touched_;               // each once
  std::vector<MeshId> destroyed_;              // since the last look
  std::vector<FaceId> fan_;
  std::int32_t mesh_count_ = 0;
  std::int64_t face_count_ = 0;
};

}  // namespace footwall::mesh
