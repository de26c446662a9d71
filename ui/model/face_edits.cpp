#include "ui/model/face_edits.h"

#include <map>
#include <utility>

namespace footwall::ui {
namespace {

using Name = std::pair<Id, std::int32_t>;

void append(Id fault, const FaultSurface& surface, std::size_t face, v1::Faces& faces) {
  faces.add_faults(fault);
  faces.add_owners(surface.faces[face].panel);
  faces.add_numbers(surface.faces[face].n);
  for (const survey::LatticePoint& corner : surface.lattice[face]) {
    faces.add_corners(corner.i);
    faces.add_corners(corner.j);
    faces.add_corners(corner.k);
  }
}

}  // namespace

std::size_t append_edits(Id fault, const FaultSurface* before, const FaultSurface* after,
                         v1::EditBatch& batch) {
  if (before == nullptr || after == nullptr) {
    v1::ReplaceFault& replace = *batch.add_edits()->mutable_replace();
    replace.set_fault(fault);
    const std::size_t count = after == nullptr ? 0 : after->faces.size();
    for (std::size_t f = 0; f < count; ++f) append(fault, *after, f, *replace.mutable_faces());
    return count;
  }
  std::map<Name, std::size_t> former;
  for (std::size_t f = 0; f < before->faces.size(); ++f)
    former[{before->faces[f].panel, before->faces[f].n}] = f;
  v1::Faces put;
  for (std::size_t f = 0; f < after->faces.size(); ++f) {
    const auto found = former.find({after->faces[f].panel, after->faces[f].n});
    const bool stands = found != former.end() && before->lattice[found->second] == after->lattice[f];
    if (found != former.end()) former.erase(found);
    if (!stands) append(fault, *after, f, put);
  }
  const auto changed = static_cast<std::size_t>(put.faults_size()) + former.size();
  if (!former.empty()) {
    v1::FaceNames& gone = *batch.add_edits()->mutable_remove();
    for (const auto& [name, place] : former) {
      gone.add_faults(fault);
      gone.add_owners(name.first);
      gone.add_numbers(name.second);
    }
  }
  if (put.faults_size() != 0) *batch.add_edits()->mutable_put() = std::move(put);
  return changed;
}

}  // namespace footwall::ui
