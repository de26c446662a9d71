#include "storage/volume/block_writer.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <limits>

#include "storage/base/hash.h"
#include "storage/volume/block_workers.h"

namespace footwall::volume {
namespace {

constexpr std::int64_t kMostInFlight = std::int64_t{128} << 20;  // bytes of blocks, if one is not larger
constexpr std::int64_t kMostWorkers = 8;  // more than a disk can follow; each keeps 3 MiB of statistics
constexpr float kNull = std::numeric_limits<float>::quiet_NaN();

std::int64_t first_inline_of(const ChunkGrid& grid, const BlockRun& run) {
  return run.empty() ? 0 : box_of_block(grid, run.first).lo[0];
}

}  // namespace

// A block on its way: what the source filled in, and the same samples chunk after chunk.
struct BlockWriter::Block {
  survey::Box box;
  std::vector<float> values;
  std::vector<std::uint8_t> live;
  Pages chunks;
};

struct BlockWriter::Strip {
  survey::Box box;
  std::vector<std::uint8_t> live;
  std::atomic<std::int64_t> missing{0};  // blocks
};

BlockRun all_blocks(const ChunkGrid& grid) {
  const survey::Index n = grid.counts();
  return {0, n[0] * n[1]};
}

survey::Box box_of_block(const ChunkGrid& grid, std::int64_t number) {
  const std::int64_t across = grid.counts()[1];
  survey::Box box = grid.box_of({number / across, number % across, 0});
  box.hi[2] = grid.dims[2];
  return box;
}

std::vector<survey::Box> strips_of(const ChunkGrid& grid, const BlockRun& run) {
  const std::int64_t across = grid.counts()[1];
  std::vector<survey::Box> strips;
  for (std::int64_t first = run.first; first < run.end;) {
    const std::int64_t end = std::min(run.end, (first / across + 1) * across);
    survey::Box strip = box_of_block(grid, first);
    strip.hi[1] = box_of_block(grid, end - 1).hi[1];
    strips.push_back(strip);
    first = end;
  }
  return strips;
}

BlockWriter::BlockWriter(const std::filesystem::path& path, std::int64_t voxels_at, const ChunkGrid& grid,
                         std::optional<float> null_value, const BlockRun& run)
    : grid_(grid),
      run_(run),
      null_value_(null_value.value_or(kNull)),
      voxels_at_(voxels_at),
      output_(path),
      min_max_(grid.dims, first_inline_of(grid, run)),
      hashes_(static_cast<std::size_t>(std::max<std::int64_t>(0, run.end - run.first) * grid.counts()[2])),
      statistics_(
          static_cast<std::size_t>(std::clamp<std::int64_t>(omp_get_max_threads(), 1, kMostWorkers))) {}

std::vector<BlockWriter::Block> BlockWriter::make_blocks() const {
  const std::int64_t traces = grid_.chunk[0] * grid_.chunk[1];
  const std::int64_t chunk_bytes =
      grid_.voxels() * grid_.counts()[2] * static_cast<std::int64_t>(sizeof(float));
  const std::int64_t each = traces * grid_.dims[2] * static_cast<std::int64_t>(sizeof(float)) + chunk_bytes;
  // One more than there are workers: it is filled while they work.
  const std::int64_t wanted =
      std::min(static_cast<std::int64_t>(statistics_.size()) + 1, run_.end - run_.first);
  std::vector<Block> blocks(
      static_cast<std::size_t>(std::clamp<std::int64_t>(kMostInFlight / each, 1, wanted)));
  for (Block& block : blocks) {
    block.values.reserve(static_cast<std::size_t>(traces * grid_.dims[2]));
    block.chunks = allocate_pages(static_cast<std::size_t>(chunk_bytes));
  }
  return blocks;
}

void BlockWriter::fill_block(Block& block, Strip& strip, const BlockSource& fill) {
  const survey::Box& box = block.box;
  block.values.resize(static_cast<std::size_t>(box.count()));
  block.live.assign(static_cast<std::size_t>(box.size(0) * box.size(1)), 1);
  fill(box, block.values, block.live);
  for (std::uint8_t& alive : block.live) alive = alive != 0 ? 1 : 0;
  for (std::int64_t i = 0; i < box.size(0); ++i) {
    std::copy_n(block.live.data() + i * box.size(1), box.size(1),
                strip.live.data() + i * strip.box.size(1) + box.lo[1] - strip.box.lo[1]);
  }
}

void BlockWriter::work_on(Block& block, SampleStatistics& statistics) {
  clean(block, statistics);
  min_max_.add(block.box, block.values);
  write_chunks(block);
}

// Nulls to NaN, dead traces to NaN, and everything into the statistics, while a trace is in the cache.
void BlockWriter::clean(Block& block, SampleStatistics& statistics) const {
  const auto samples = static_cast<std::size_t>(block.box.size(2));
  for (std::size_t trace = 0; trace < block.live.size(); ++trace) {
    const std::span<float> values = std::span(block.values).subspan(trace * samples, samples);
    if (block.live[trace] == 0) {
      std::fill(values.begin(), values.end(), kNull);
    } else {
      clean_in_place(values, null_value_);
    }
    statistics.add(values);
  }
}

// A block's chunks follow each other in the file: they go out as one piece.
void BlockWriter::write_chunks(Block& block) {
  const survey::Box touched = grid_.touched_by(block.box);
  const std::int64_t voxels = grid_.voxels();
  const std::int64_t count = touched.size(2);
  const std::int64_t first = grid_.number_of({touched.lo[0], touched.lo[1], 0});
  const std::int64_t first_of_run = run_.first * count;
  auto* chunks = reinterpret_cast<float*>(block.chunks.get());
  for (std::int64_t c = 0; c < count; ++c) {
    const survey::Index place{touched.lo[0], touched.lo[1], c};
    const survey::Box part = grid_.box_of(place);
    float* chunk = chunks + c * voxels;
    if (part.count() < voxels) std::fill_n(chunk, voxels, 0.0F);
    copy_clean(part, block.box, block.values.data(), grid_.full_box_of(place), chunk, kNull);
    hashes_[static_cast<std::size_t>(first - first_of_run + c)] =
        hash64(std::as_bytes(std::span(chunk, static_cast<std::size_t>(voxels))));
  }
  const auto bytes = static_cast<std::size_t>(count * voxels) * sizeof(float);
  output_.write(voxels_at_ + first * voxels * static_cast<std::int64_t>(sizeof(float)),
                std::span(block.chunks.get(), bytes));
}

void BlockWriter::write(const BlockSource& fill, const std::function<void(std::int64_t)>& before,
                        const std::function<void(const survey::Box&, std::span<const std::uint8_t>)>& live) {
  if (run_.empty()) return;
  std::vector<Block> blocks = make_blocks();
  std::vector<Strip*> strip_of(blocks.size());
  std::deque<Strip> strips;  // those that are not whole yet
  std::int64_t filled = 0;   // voxels
  const auto hand_over_whole_ones = [&] {
    while (!strips.empty() && strips.front().missing.load(std::memory_order_acquire) == 0) {
      live(strips.front().box, strips.front().live);
      strips.pop_front();
    }
  };
  BlockWorkers workers(statistics_.size(), blocks.size(), [&](std::size_t slot, std::size_t worker) {
    work_on(blocks[slot], statistics_[worker]);
    strip_of[slot]->missing.fetch_sub(1, std::memory_order_release);
  });
  std::int64_t number = run_.first;
  for (const survey::Box& box : strips_of(grid_, run_)) {
    Strip& strip = strips.emplace_back();
    strip.box = box;
    strip.live.assign(static_cast<std::size_t>(box.size(0) * box.size(1)), 0);
    const std::int64_t count = grid_.touched_by(box).size(1);
    strip.missing = count;
    for (std::int64_t n = 0; n < count; ++n, ++number) {
      before(filled);
      const std::size_t slot = workers.take_free();
      hand_over_whole_ones();
      Block& block = blocks[slot];
      block.box = box_of_block(grid_, number);
      fill_block(block, strip, fill);
      strip_of[slot] = &strip;
      filled += block.box.count();
      workers.submit(slot);
    }
  }
  workers.finish();
  hand_over_whole_ones();
}

SampleStatistics& BlockWriter::statistics() {
  for (std::size_t t = 1; t < statistics_.size(); ++t) statistics_.front().merge(statistics_[t]);
  return statistics_.front();
}

}  // namespace footwall::volume
