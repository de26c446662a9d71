// EXTRACT-ALL of faces that change a few at a time: only the faces that an edit touched are voxelized, and
// only their values or sums move; every number is the one that a full extraction gives, bit for bit.
// Based on: seed 004, section 2.7.4 (move-extract cycles), and its chapter 4 for who is responsible: a face
// that is unchanged keeps its rank. Differs in that nothing at all is done for unchanged faces.
//
// An update costs time, memory traffic and messages in proportion to the faces touched, whatever the number
// of faces: with exchange `reduce`, one message for each pair of ranks that share a touched face, one from
// each responsible rank to rank 0, and one small Allreduce in which the ranks agree on the outcome. Balancing
// is the exception: all but `none` and `auto` look at every face, to know the load that is there.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/extract/extract.h"
#include "engine/extract/face_changes.h"

namespace footwall::extract {

// Where a face stands in Incremental: small numbers, kept as long as the face is there, then used again.
using Place = std::uint32_t;

// What one update did. The faces that were extracted come as added, then changed, in the order of the lists.
struct Update {
  std::vector<Place> places;               // of the extracted faces; on every rank
  std::vector<Place> freed;                // of the removed faces; on every rank
  std::vector<FaceStatistics> statistics;  // of the extracted faces, at rank 0; empty elsewhere
  std::vector<FaceBlobs> blobs;            // the same, one for each whole-face computation
  // Of this update: faces, voxels, bytes, messages and seconds are those of the extracted faces; checksum is
  // 0. load_deviation is of all faces.
  Report report;
};

class Incremental {
 public:
  // No faces at first. `survey` must outlive it and is not used by others during a call. max_abs: as in
  // Input. Throws kUsage for options that extract_all would refuse. Not collective, alike on every rank.
  Incremental(LoadedSurvey& survey, double max_abs, Options options);
  ~Incremental();
  Incremental(const Incremental&) = delete;
  Incremental& operator=(const Incremental&) = delete;

  // Takes the changes, the same on every rank, and extracts the added and the changed faces. Collective. The
  // reference holds until the next call. Throws, on every rank, kInvalid for an identity that is there
  // already, is not there, or stands twice in the lists, and as extract_all; after any of them the faces and
  // numbers are those of before the call.
  const Update& update(const FaceChanges& changes, const JobContext& job = {});

  // How many faces there are; places are below place_limit(), some of them free.
  std::size_t size() const;
  Place place_limit() const;
  std::optional<Place> place_of(const FaceIdentity& identity) const;
  // The face at a place; null for a free one.
  const Face* face(Place place) const;
  // Its responsible rank; -1 for a free place.
  int responsible(Place place) const;
  // Its numbers, at rank 0 only.
  const FaceStatistics& statistics(Place place) const;

  // All of them, ascending by identity. Time in proportion to all faces.
  std::vector<Face> faces() const;
  // In the order of faces(), at rank 0; empty elsewhere.
  std::vector<FaceStatistics> all_statistics() const;

 private:
  std::vector<Place> by_identity() const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::extract
