#include "engine/service/client/edit_journal.h"

#include "engine/service/wire.h"

namespace footwall::service {
namespace {

constexpr std::size_t kFacesInBatch = std::size_t{1} << 17;

v1::Faces message_of_one(const extract::FaceIdentity& name, const survey::LatticeTriangle& triangle) {
  extract::Face face;
  face.fault = name.fault;
  face.owner = name.owner;
  face.n = name.n;
  face.triangle = triangle;
  return message_of(std::span<const extract::Face>(&face, 1));
}

// Puts edits into batches of a bearable size.
class Packer {
 public:
  v1::Edit& add(std::size_t faces) {
    if (batches_.empty() || faces_ >= kFacesInBatch) {
      batches_.emplace_back();
      faces_ = 0;
    }
    faces_ += faces;
    return *batches_.back().add_edits();
  }
  std::vector<v1::EditBatch> take() { return std::move(batches_); }

 private:
  std::vector<v1::EditBatch> batches_;
  std::size_t faces_ = 0;
};

}  // namespace

void EditJournal::add(const v1::EditBatch& batch) {
  for (const v1::Edit& edit : batch.edits()) {
    switch (edit.what_case()) {
      case v1::Edit::kMesh:
        mesh_operations_.push_back(edit.mesh());
        break;
      case v1::Edit::kPut:
        for (const extract::Face& face : faces_from(edit.put()))
          faults_[face.fault].faces[extract::identity_of(face)] = face.triangle;
        break;
      case v1::Edit::kRemove:
        for (const extract::FaceIdentity& name : names_from(edit.remove())) {
          Fault& fault = faults_[name.fault];
          if (fault.whole) {
            fault.faces.erase(name);
          } else {
            fault.faces[name] = std::nullopt;
          }
        }
        break;
      case v1::Edit::kReplace: {
        Fault& fault = faults_[edit.replace().fault()];
        fault = {.whole = true, .faces = {}};
        for (const extract::Face& face : faces_from(edit.replace().faces()))
          fault.faces[extract::identity_of(face)] = face.triangle;
        break;
      }
      case v1::Edit::kClear:
        if (!edit.clear()) break;
        clear();
        cleared_ = true;
        break;
      case v1::Edit::WHAT_NOT_SET:
        break;  // no engine has taken it
    }
  }
}

void EditJournal::clear() {
  cleared_ = false;
  mesh_operations_.clear();
  faults_.clear();
}

std::vector<v1::EditBatch> EditJournal::batches() const {
  Packer packer;
  if (cleared_) packer.add(1).set_clear(true);
  for (const std::string& operation : mesh_operations_) packer.add(1).set_mesh(operation);
  for (const auto& [number, fault] : faults_) {
    if (fault.whole) {
      v1::ReplaceFault& replace = *packer.add(fault.faces.size()).mutable_replace();
      replace.set_fault(number);
      for (const auto& [name, triangle] : fault.faces)
        replace.mutable_faces()->MergeFrom(message_of_one(name, *triangle));
      continue;
    }
    for (const auto& [name, triangle] : fault.faces) {
      // One that the project has lost, too, cannot be taken away again: it is put there first.
      *packer.add(1).mutable_put() = message_of_one(name, triangle.value_or(survey::LatticeTriangle{}));
      if (triangle) continue;
      v1::FaceNames& names = *packer.add(1).mutable_remove();
      names.add_faults(name.fault);
      names.add_owners(name.owner);
      names.add_numbers(name.n);
    }
  }
  return packer.take();
}

}  // namespace footwall::service
