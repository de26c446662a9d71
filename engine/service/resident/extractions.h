// Which faces changed since the last extraction, for a few pairs of volume and options.
#pragma once
#include <cstdint>
#include <list>
#include <memory>
#include <set>
#include <span>
#include <string>

#include "engine/extract/incremental.h"
#include "engine/service/resident/face_model.h"
#include "engine/service/resident/open_volumes.h"

namespace footwall::service {

// Extractions of one volume with the same options. Alike on every rank.
struct Extraction {
  std::string volume;
  survey::Index origin{0, 0, 0};  // of its first voxel in the survey
  extract::Options options;
  // Holds the faces that were extracted, as they were then. None for options that it refuses (offset).
  std::unique_ptr<extract::Incremental> incremental;
  // Names of faces that may not be as they were extracted; for faces that never were, once `complete`.
  std::set<extract::FaceIdentity> touched;
  bool complete = false;  // all faces were extracted once, so that the touched ones are what is left to do

  // From the extracted faces to the model's, of the touched faces alone; in the volume's index space. Throws
  // kInvalid for a face that is too far away from it.
  extract::FaceChanges changes(const FaceModel::Faces& model) const;
};

class Extractions {
 public:
  // The one of a volume and options, made where there is none; the least recently used goes where there are
  // too many. Valid until the next call. Not collective, alike on every rank; throws kUsage for options that
  // extract_all would refuse.
  Extraction& of(const OpenVolume& volume, const extract::Options& options);
  void touch(std::span<const extract::FaceIdentity> names, std::size_t faces);
  // By the estimate of memory_needs.h.
  std::int64_t memory_bytes() const;
  // The volume is closed.
  void forget(const std::string& volume);

 private:
  std::list<Extraction> all_;  // the last used first
};

}  // namespace footwall::service
