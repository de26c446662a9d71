// The way of blocks into a volume file's chunks: one thread asks the source, others clean, fold, hash and
// write; what the file's tables need of them is kept. No call of HDF5: a serial writer has one of these, a
// parallel one has one on each rank.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "storage/base/pages.h"
#include "storage/volume/chunk_grid.h"
#include "storage/volume/chunk_output.h"
#include "storage/volume/min_max_builder.h"
#include "storage/volume/statistics.h"
#include "storage/volume/volume_writer.h"

namespace footwall::volume {

// Blocks `first` to before `end`; a block is chunk-inlines x chunk-crosslines x all samples, numbered inlines
// slowest. Its chunks follow each other in the file.
struct BlockRun {
  std::int64_t first = 0;
  std::int64_t end = 0;
  bool empty() const { return first >= end; }
};
BlockRun all_blocks(const ChunkGrid& grid);
survey::Box box_of_block(const ChunkGrid& grid, std::int64_t number);
// The run's blocks of the same inlines, as boxes, in order: whole layers but for the first and the last.
std::vector<survey::Box> strips_of(const ChunkGrid& grid, const BlockRun& run);

class BlockWriter {
 public:
  // The file must exist; its chunks begin at voxels_at. Throws kIo.
  BlockWriter(const std::filesystem::path& path, std::int64_t voxels_at, const ChunkGrid& grid,
              std::optional<float> null_value, const BlockRun& run);

  // Asks `fill` for all blocks of the run. Called in between, from this thread too: `before` with how many
  // voxels were asked for, before each block; `live` with each strip, in order, when all blocks up to its end
  // are written, with its mask [inline][crossline]. What any of them throws ends it, as do kIo, kMemory.
  void write(const BlockSource& fill, const std::function<void(std::int64_t voxels)>& before,
             const std::function<void(const survey::Box& strip, std::span<const std::uint8_t> mask)>& live);

  // Rows of the pyramid's level 0 as MinMaxBuilder::take_finished: those that this run touches.
  std::vector<MinMaxRow> take_finished(std::int64_t next_inline) {
    return min_max_.take_finished(next_inline);
  }
  // Of the run's chunks, in their order.
  std::span<const std::uint64_t> hashes() const { return hashes_; }
  // Of all that was written; call it once.
  SampleStatistics& statistics();
  // Waits until the chunks are on the disk. Throws kIo.
  void flush() const { output_.flush(); }

 private:
  struct Block;
  struct Strip;
  std::vector<Block> make_blocks() const;
  static void fill_block(Block& block, Strip& strip, const BlockSource& fill);
  void work_on(Block& block, SampleStatistics& statistics);
  void clean(Block& block, SampleStatistics& statistics) const;
  void write_chunks(Block& block);

  ChunkGrid grid_;
  BlockRun run_;
  float null_value_;
  std::int64_t voxels_at_;
  ChunkOutput output_;
  MinMaxBuilder min_max_;
  std::vector<std::uint64_t> hashes_;
  std::vector<SampleStatistics> statistics_;  // one a worker
};

}  // namespace footwall::volume
