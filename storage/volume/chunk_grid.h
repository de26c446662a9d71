// How a volume is cut into chunks, and the copies between a box of samples and the chunks.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "storage/survey/box.h"

namespace footwall::volume {

// Chunks are numbered like voxels: inline slowest, sample fastest. Chunks at the far ends reach beyond the
// volume; on disk they are full, the part outside filled with zeros, which the hash covers.
struct ChunkGrid {
  survey::Index dims{1, 1, 1};
  survey::Index chunk{1, 1, 1};

  survey::Index counts() const {
    return {(dims[0] + chunk[0] - 1) / chunk[0], (dims[1] + chunk[1] - 1) / chunk[1],
            (dims[2] + chunk[2] - 1) / chunk[2]};
  }
  std::int64_t count() const {
    const survey::Index n = counts();
    return n[0] * n[1] * n[2];
  }
  std::int64_t voxels() const { return chunk[0] * chunk[1] * chunk[2]; }  // of one chunk
  std::int64_t number_of(const survey::Index& c) const {
    const survey::Index n = counts();
    return (c[0] * n[1] + c[1]) * n[2] + c[2];
  }
  survey::Index place_of(std::int64_t number) const {
    const survey::Index n = counts();
    return {number / (n[1] * n[2]), number / n[2] % n[1], number % n[2]};
  }
  // The voxels of chunk c that are inside the volume.
  survey::Box box_of(const survey::Index& c) const;
  // The same with the padding.
  survey::Box full_box_of(const survey::Index& c) const;
  // The chunks that a box of voxels touches, as a box of chunk places.
  survey::Box touched_by(const survey::Box& box) const;
};

// Throws kInternal unless the box is empty or inside the volume and `values` is its count.
void require_box(const ChunkGrid& grid, const survey::Box& box, std::size_t values);

// Copies `part` (inside both) from an array over `from_box` to an array over `to_box`, both
// [inline][crossline][sample]; samples that are not finite or equal null_value become quiet NaN.
// Pass a NaN as null_value where there is none.
void copy_clean(const survey::Box& part, const survey::Box& from_box, const float* from,
                const survey::Box& to_box, float* to, float null_value);

// The same rule in place.
void clean_in_place(std::span<float> values, float null_value);

}  // namespace footwall::volume
