// Faces that come, change and go, as plain values.
#pragma once
#include <compare>
#include <cstdint>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

// A face's name without its corners: that of Face.
struct FaceIdentity {
  std::int64_t fault = 0;
  std::int64_t owner = 0;
  std::int32_t n = 0;
  friend auto operator<=>(const FaceIdentity&, const FaceIdentity&) = default;
};

inline FaceIdentity identity_of(const Face& face) {
  return {face.fault, face.owner, face.n};
}

// What is not as it was, each face in one list, ascending by identity; added and changed faces as they are
// now.
struct FaceChanges {
  std::vector<Face> added;
  std::vector<Face> changed;
  std::vector<FaceIdentity> removed;
  bool empty() const { return added.empty() && changed.empty() && removed.empty(); }
};

}  // namespace footwall::extract
