// The results of all ranks at rank 0.
#pragma once
#include <span>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/face_blobs.h"

namespace footwall::extract {

// Keeps its buffers from one extraction to the next.
class Gather {
 public:
  // Room for the results of faces with these responsible ranks: `faces` gets one for each at rank 0 and none
  // elsewhere. Not collective; throws std::bad_alloc.
  void prepare(const comm::Communicator& world, std::span<const int> responsible,
               std::vector<FaceStatistics>& faces);

  // After prepare() with the same ranks and faces: one message from each rank that is responsible for a face
  // to rank 0, whose size both know. A face that is not among `finished` (its rank failed) has default
  // numbers. Collective, without agreement.
  void statistics(comm::Communicator& world, std::span<const int> responsible,
                  std::span<const Finished> finished, std::vector<FaceStatistics>& faces);

 private:
  std::vector<std::int64_t> counts_;  // faces of each rank
  std::vector<std::size_t> mine_;     // the faces of this rank, ascending
  std::vector<FaceStatistics> sent_;  // of mine_
  std::vector<std::vector<FaceStatistics>> received_;
  std::vector<comm::KnownOutgoing> outgoing_;
  std::vector<comm::KnownIncoming> incoming_;
};

// The whole-face results of all ranks at rank 0, one for each computation. Collective; agrees on memory.
std::vector<FaceBlobs> gather_blobs(comm::Communicator& world, std::vector<FinishedBlob> mine,
                                    std::span<const Computation* const> computations, std::size_t faces);

}  // namespace footwall::extract
