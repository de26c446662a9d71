// What an extraction will compute and send, estimated from some of its faces: cheap enough to be done before
// every extraction, where the replay (replay/replay.h) voxelizes them all.
// Sums are in a fixed order and use no function of the C library, so that all ranks get the same bits.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/face.h"

namespace footwall::extract {

// Of one rank, in one extraction. "Distinct" counts a voxel once for each pair of ranks.
struct RankAmounts {
  double faces = 0;   // that it is responsible for
  double voxels = 0;  // of those faces: its load
  double owned = 0;   // voxels of any face in its own part
  double owned_faces = 0;
  double received = 0, sent = 0;                    // distinct remote voxels
  double blocks_received = 0, blocks_sent = 0;      // the same with the blocks around them
  double bounding_received = 0, bounding_sent = 0;  // the same of the bounding volumes
  double pieces_received = 0, pieces_sent = 0;      // faces with voxels on an owner and its receiver
  double partners_received = 0, partners_sent = 0;  // ranks
};

// Whose sums depend on the decomposition and the faces, but on no balancer: made once, used for many.
class FaceSample {
 public:
  // reach: traces around each voxel that are needed, too. blocks: sides B of `block`. At most `most` faces
  // are looked at, spread over the input. O(most).
  FaceSample(const comm::RankGrid& grid, std::span<const Face> faces, int reach, int block,
             std::size_t most = 1024);

  // responsible: of every face of the input. weights: voxels of every face, so that loads are exact.
  // Throws kInternal where the sizes differ.
  std::vector<RankAmounts> amounts(std::span<const int> responsible, std::span<const std::int64_t> weights) const;

  // Voxels of all faces of the sample, inside the survey, scaled to the whole input.
  double voxels() const { return voxels_; }

 private:
  struct Piece {
    std::size_t face;  // its place in the input
    int owner;
    double voxels, blocks, bounding;
  };
  const comm::RankGrid& grid_;
  std::size_t faces_;
  double scale_ = 1;  // faces of the input for each of the sample
  std::vector<Piece> pieces_;
  std::vector<double> volumes_;  // voxels of each rank's part
  double voxels_ = 0;
};

}  // namespace footwall::extract
