// Edits that an engine has taken and the project does not have yet, in the fewest words: what a fresh engine
// is told after the project was replayed. Its size follows the faces that were edited, not how often.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/extract/face_changes.h"
#include "engine/service/engine.pb.h"

namespace footwall::service {

class EditJournal {
 public:
  // A batch that the engine has applied.
  void add(const v1::EditBatch& batch);
  void clear();
  // Batches, without numbers, none of them huge; they hold whatever the project has by then.
  std::vector<v1::EditBatch> batches() const;

 private:
  // What a fault of the project is by now: all faces, or some that are there or not.
  struct Fault {
    bool whole = false;
    std::map<extract::FaceIdentity, std::optional<survey::LatticeTriangle>> faces;
  };

  bool cleared_ = false;
  std::vector<std::string> mesh_operations_;  // each makes sense only after those before it
  std::map<std::int64_t, Fault> faults_;
};

}  // namespace footwall::service
