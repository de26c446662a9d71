// The samples around a surface, in bricks: what faces show that are coloured by the voxels that they cut.
// Bricks belong to places in the volume, not to triangles, so that a face which moves within them shows what
// is there at once.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "storage/volume/volume_reader.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

// Every `step`-th sample of a volume along each axis, where a surface passes. Brick (a, b, c) holds the
// samples 8a to 8a + 8 of those, neighbours share a layer: what lies between samples needs one brick alone.
struct VoxelBricks {
  static constexpr std::int64_t kCells = 8;
  static constexpr std::int64_t kSide = kCells + 1;
  static constexpr std::int64_t kSamples = kSide * kSide * kSide;
  static constexpr std::uint32_t kFree = 0xFFFFFFFF;

  Id volume = 0;
  std::int64_t step = 1;
  survey::Index origin{};  // of the volume in the survey
  survey::Index size{};    // samples of the volume, all of them
  // Open addressing: a brick's key stands at slot_of(key) or in one of the `longest` - 1 slots after it. A
  // power of two of slots.
  std::vector<std::array<std::uint32_t, 2>> table;  // key and number of the brick
  int longest = 0;
  std::vector<float> samples;  // [brick][i][j][k]; NaN: null, or beyond the volume

  std::size_t count() const { return samples.size() / kSamples; }
  survey::Index sampled() const;  // samples along each axis at this step
  survey::Index bricks() const;   // bricks that the volume would have
  std::uint32_t slot_of(std::uint32_t key) const;
  // The brick's samples; null where the surface did not pass.
  const float* find(std::uint32_t key) const;
  // The sample nearest to a place of the survey's index space: NaN where null or outside; nothing where no
  // brick was read.
  std::optional<float> nearest(const survey::IndexPoint& place) const;
};

// Keys, ascending, of the bricks that the surface passes through at bricks.step; some that it only comes near
// may be among them. Corners that are not finite make no brick.
std::vector<std::uint32_t> passed_bricks(const FaultSurface& surface, const survey::Geometry& survey,
                                         const VoxelBricks& bricks);

// The bricks of a surface: step 1, or the least power of two at which they are at most `most`. What `known`
// holds of the same volume and step is not read again. Each chunk is read once. Nothing where stop() said so,
// which is asked before each chunk. Throws as VolumeReader::read.
std::optional<VoxelBricks> read_bricks(const volume::VolumeReader& reader, Id volume,
                                       const survey::Index& origin, const survey::Geometry& survey,
                                       const FaultSurface& surface, std::size_t most,
                                       const VoxelBricks* known, const std::function<bool()>& stop);

}  // namespace footwall::ui
