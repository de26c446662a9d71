// What an extraction will compute and send, estimated from some of its faces: cheap enough to be done before
// every extraction, where the replay (replay/replay.h) voxelizes them all.
// Sums are in a fixed order and use no function of the C library, so that all ranks get the same bits.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/face.h"

namespace footwall::extract {

// The sides B of `block` that are counted.
inline constexpr std::array<int, 2> kBlockSides{2, 4};

// Of one rank, in one extraction. What is sent or received counts a voxel once for each pair of ranks.
struct RankAmounts {
  double faces = 0;            // that it is responsible for
  double voxels = 0;           // of those faces: its load
  double owned = 0;            // voxels of any face in its own part
  double owned_elsewhere = 0;  // of them, those of faces for which another rank is responsible
  double owned_faces = 0;      // faces with voxels in its own part
  double received = 0, sent = 0;
  std::array<double, kBlockSides.size()> blocks_received{}, blocks_sent{};  // with the blocks around them
  double bounding_received = 0, bounding_sent = 0;                          // the faces' bounding volumes
  double pieces_received = 0, pieces_sent = 0;      // faces with voxels on an owner that is not responsible
  double partners_received = 0, partners_sent = 0;  // ranks
};

// The number of voxels of each face inside the survey, rounded: exact on average (cover.h). O(faces).
std::vector<std::int64_t> expected_voxels(std::span<const Face> faces, const survey::Index& dims);

// Where the voxels of some faces are. That depends on the decomposition, but on no balancer: made once, used
// for many.
class FaceSample {
 public:
  // reach: traces around each voxel that are needed, too. At most `most` faces are looked at, spread over the
  // input. O(most), but for faces that meet many ranks.
  FaceSample(const comm::RankGrid& grid, std::span<const Face> faces, int reach, std::size_t most = 1024);

  // responsible, voxels: of every face of the input. Throws kInternal where the sizes differ. O(faces).
  std::vector<RankAmounts> amounts(std::span<const int> responsible,
                                   std::span<const std::int64_t> voxels) const;

 private:
  struct Piece {
    std::size_t face = 0;  // its place in the input
    int owner = 0;
    double voxels = 0;
    double needed = 0;  // with what lies around them
    std::array<double, kBlockSides.size()> blocks{};
    double bounding = 0;
  };
  void add(const comm::RankGrid& grid, std::size_t face, const survey::LatticeTriangle& triangle, int reach);

  std::size_t ranks_;
  std::size_t faces_;
  double scale_ = 1;             // faces of the input for each of the sample
  std::vector<double> volumes_;  // voxels of each rank's part
  std::vector<Piece> pieces_;
};

}  // namespace footwall::extract
