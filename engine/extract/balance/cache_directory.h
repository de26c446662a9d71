// Which parts of the survey each rank has received from others and keeps: the same on every rank, because it
// follows from the faces and ranks of the extractions so far, and no message tells of it. Coarse: it speaks
// of cells of 16 x 16 traces (larger ones for surveys and rank counts that would need more memory), all
// samples, so that it says where voxels may be at hand, not which.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/face.h"

namespace footwall::extract {

class CacheDirectory {
 public:
  // Empty. most_bytes: the side of the cells is doubled until one bit for each rank and cell fits.
  // Throws std::bad_alloc.
  explicit CacheDirectory(const comm::RankGrid& grid, std::int64_t most_bytes = std::int64_t{8} << 20);

  // After an extraction: each rank now holds what its faces cut, as far as it does not own it. Faces without
  // a rank (-1) are left out. Throws kInternal where there is not one rank for every face.
  void add(std::span<const Face> faces, std::span<const int> responsible);
  // With the cache itself.
  void clear();

  // Whether `rank` has received voxels in a cell that meets the box.
  bool holds(int rank, const survey::Box& box) const;
  bool empty() const { return empty_; }
  // Traces along a cell's side.
  std::int64_t cell() const { return cell_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(words_.size() * sizeof(std::uint64_t)); }

 private:
  void mark(const survey::LatticeTriangle& triangle, int rank);
  std::size_t word(std::int64_t a, std::int64_t b, int rank) const {
    return (static_cast<std::size_t>(rank) * static_cast<std::size_t>(cells_[0]) +
            static_cast<std::size_t>(a)) *
               words_per_row_ +
           static_cast<std::size_t>(b / 64);
  }

  comm::RankGrid grid_;
  std::int64_t cell_ = 16;
  std::array<std::int64_t, 2> cells_{0, 0};  // along inlines and crosslines
  std::size_t words_per_row_ = 0;
  std::vector<std::uint64_t> words_;  // [rank][cell along inlines][cells along crosslines, 64 a word]
  bool empty_ = true;
};

}  // namespace footwall::extract
