#include "storage/volume/volume_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>
#include <cmath>
#include <cstring>

#include <atomic>
#include <cerrno>
#include <deque>
#include <limits>

#include "storage/base/byte_rate.h"
#include "storage/base/hash.h"
#include "storage/base/pages.h"
#include "storage/base/partial_file.h"
#include "storage/volume/block_workers.h"
#include "storage/volume/chunk_output.h"
#include "storage/volume/description.h"
#include "storage/volume/disk_room.h"
#include "storage/volume/min_max_builder.h"
#include "storage/volume/preamble.h"
#include "storage/volume/statistics.h"
#include "storage/volume/volume_file.h"

namespace footwall::volume {
namespace {

constexpr std::int64_t kDefaultSide = 32;
constexpr std::int64_t kDefaultBlockBytes = std::int64_t{64} << 20;
constexpr std::int64_t kMostBlockBytes = std::int64_t{1} << 30;
constexpr std::int64_t kMostInFlight = std::int64_t{128} << 20;  // bytes of blocks, if one is not larger
constexpr std::int64_t kMostWorkers = 8;  // more than a disk can follow; each keeps 3 MiB of statistics
constexpr float kNull = std::numeric_limits<float>::quiet_NaN();

std::int64_t block_bytes(const survey::Index& dims, const survey::Index& chunk) {
  return chunk[0] * chunk[1] * (dims[2] + chunk[2]) * static_cast<std::int64_t>(sizeof(float));
}

survey::Index checked_chunk(const WriteOptions& options) {
  const survey::Index dims = options.geometry.dims();
  survey::Index chunk = options.chunk.value_or(default_chunk(dims));
  for (int axis = 0; axis < 3; ++axis) {
    if (chunk[axis] < 1) throw Error(ErrorCode::kInvalid, "a chunk needs at least one voxel on each axis");
    chunk[axis] = std::min(chunk[axis], dims[axis]);
  }
  // Sides are at most 2^23, so that only the product of all three could overflow.
  if (chunk[0] * chunk[1] > kMostBlockBytes / 4 || block_bytes(dims, chunk) > kMostBlockBytes) {
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("chunks of {} x {} x {} make blocks of more than 1 GiB", chunk[0], chunk[1], chunk[2]),
        "use fewer inlines and crosslines a chunk");
  }
  return chunk;
}

void write_preamble(const std::filesystem::path& path, const Preamble& preamble) {
  const std::string text = encoded(preamble);
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw io_error("open", path, errno);
  const ssize_t written = ::pwrite(descriptor, text.data(), text.size(), 0);
  const int failure = errno;
  ::close(descriptor);
  if (written != static_cast<ssize_t>(text.size())) throw io_error("write", path, failure);
}

// A block on its way: what the source filled in, and the same samples chunk after chunk.
struct Block {
  survey::Box box;
  std::vector<float> values;
  std::vector<std::uint8_t> live;
  Pages chunks;
};

// The blocks of one range of inlines; its tables are written when the last one is done.
struct Layer {
  survey::Box box;
  std::vector<std::uint8_t> live;
  std::atomic<std::int64_t> missing{0};  // blocks
};

// One file while it is being written. The thread that made it asks the source and makes all calls of HDF5;
// workers clean, fold, hash and write the blocks, in any order: nothing that is stored depends on it.
class Writing {
 public:
  Writing(const std::filesystem::path& temporary, const VolumeInfo& info)
      : path_(temporary),
        grid_{info.dims, info.chunk},
        null_value_(info.null_value.value_or(kNull)),
        min_max_(info.dims),
        statistics_(
            static_cast<std::size_t>(std::clamp<std::int64_t>(omp_get_max_threads(), 1, kMostWorkers))) {
    create_file();  // finds out whether there is room, before memory is taken for what would not fit
    hashes_.resize(static_cast<std::size_t>(grid_.count()));
    create_datasets();
  }

  void write_blocks(const BlockSource& fill, const JobContext& job);
  // Writes the tables and attributes, closes the file and completes `info`.
  void finish(VolumeInfo& info);

 private:
  void create_file();
  void create_datasets();
  std::vector<Block> make_blocks() const;
  void fill_block(Block& block, Layer& layer, const BlockSource& fill);
  void work_on(Block& block, SampleStatistics& statistics);
  void clean(Block& block, SampleStatistics& statistics) const;
  void write_chunks(Block& block);
  void write_finished(std::deque<Layer>& layers);
  void write_min_max(std::int64_t next_inline);
  void write_coarser_levels();

  std::filesystem::path path_;
  ChunkGrid grid_;
  float null_value_;
  MinMaxBuilder min_max_;
  std::vector<std::uint64_t> hashes_;
  std::vector<SampleStatistics> statistics_;  // one a worker
  std::int64_t live_traces_ = 0;
  Hasher live_hash_;
  Hasher min_max_hash_;
  std::int64_t min_max_rows_ = 0;
  std::int64_t voxels_at_ = 0;
  std::unique_ptr<ChunkOutput> output_;  // of the voxels
  Handle file_;                          // before the datasets: they are closed first
  Handle voxels_;
  Handle live_;
  Handle level0_;
};

void Writing::create_file() {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The newer layout finds chunks by arithmetic instead of a tree, and guards its own tables with checksums.
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_alignment(access.id(), 1 << 16, 1 << 12);
  H5Pset_file_locking(access.id(), false, true);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(creation.id(), Preamble::kSize);
  H5Pset_obj_track_times(creation.id(), false);
  file_ = Handle(H5Fcreate(path_.c_str(), H5F_ACC_EXCL, creation.id(), access.id()), H5Fclose);
  if (!file_) throw_hdf5(ErrorCode::kIo, fmt::format("cannot create {}", path_.string()));
  reserve(path_, expected_bytes(grid_));
}

void Writing::create_datasets() {
  const auto size = [&](int axis) { return static_cast<hsize_t>(grid_.dims[axis]); };
  const survey::Index n = min_max_dims(grid_.dims, 0);
  {
    const Handle plan(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(plan.id(), false);
    const Handle group(H5Gcreate2(file_.id(), kMinMax, H5P_DEFAULT, plan.id(), H5P_DEFAULT), H5Gclose);
    if (!group) throw_hdf5(ErrorCode::kIo, "cannot create the min/max pyramid");
  }
  live_ = create_plain(file_.id(), kLive, H5T_STD_U8LE, {size(0), size(1)});
  level0_ =
      create_plain(file_.id(), fmt::format("{}/0", kMinMax), H5T_IEEE_F32LE,
                   {static_cast<hsize_t>(n[0]), 3, static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[2])});

  const Handle plan(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  hsize_t chunk[3];
  for (int axis = 0; axis < 3; ++axis) chunk[axis] = static_cast<hsize_t>(grid_.chunk[axis]);
  H5Pset_chunk(plan.id(), 3, chunk);
  H5Pset_obj_track_times(plan.id(), false);
  H5Pset_alloc_time(plan.id(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(plan.id(), H5D_FILL_TIME_NEVER);
  const hsize_t dims[3] = {size(0), size(1), size(2)};
  const Handle space(H5Screate_simple(3, dims, nullptr), H5Sclose);
  voxels_ =
      Handle(H5Dcreate2(file_.id(), kVoxels, H5T_IEEE_F32LE, space.id(), H5P_DEFAULT, plan.id(), H5P_DEFAULT),
             H5Dclose);
  if (!voxels_) throw_hdf5(ErrorCode::kIo, "cannot create the voxels");
  const hsize_t first[3] = {0, 0, 0};
  haddr_t address = HADDR_UNDEF;
  hsize_t bytes = 0;
  unsigned filters = 0;
  if (H5Dget_chunk_info_by_coord(voxels_.id(), first, &filters, &address, &bytes) < 0 ||
      address == HADDR_UNDEF) {
    throw_hdf5(ErrorCode::kInternal, "HDF5 does not say where the voxels are");
  }
  voxels_at_ = static_cast<std::int64_t>(address) + Preamble::kSize;
  output_ = std::make_unique<ChunkOutput>(path_);
}

std::vector<Block> Writing::make_blocks() const {
  const std::int64_t traces = grid_.chunk[0] * grid_.chunk[1];
  const std::int64_t chunk_bytes =
      grid_.voxels() * grid_.counts()[2] * static_cast<std::int64_t>(sizeof(float));
  const std::int64_t each = traces * grid_.dims[2] * static_cast<std::int64_t>(sizeof(float)) + chunk_bytes;
  const survey::Index n = grid_.counts();
  // One more than there are workers: it is filled while they work.
  const std::int64_t wanted = std::min(static_cast<std::int64_t>(statistics_.size()) + 1, n[0] * n[1]);
  std::vector<Block> blocks(
      static_cast<std::size_t>(std::clamp<std::int64_t>(kMostInFlight / each, 1, wanted)));
  for (Block& block : blocks) {
    block.values.reserve(static_cast<std::size_t>(traces * grid_.dims[2]));
    block.chunks = allocate_pages(static_cast<std::size_t>(chunk_bytes));
  }
  return blocks;
}

void Writing::fill_block(Block& block, Layer& layer, const BlockSource& fill) {
  const survey::Box& box = block.box;
  block.values.resize(static_cast<std::size_t>(box.count()));
  block.live.assign(static_cast<std::size_t>(box.size(0) * box.size(1)), 1);
  fill(box, block.values, block.live);
  for (std::uint8_t& alive : block.live) {
    alive = alive != 0 ? 1 : 0;
    live_traces_ += alive;
  }
  for (std::int64_t i = 0; i < box.size(0); ++i) {
    std::copy_n(block.live.data() + i * box.size(1), box.size(1),
                layer.live.data() + i * layer.box.size(1) + box.lo[1]);
  }
}

void Writing::work_on(Block& block, SampleStatistics& statistics) {
  clean(block, statistics);
  min_max_.add(block.box, block.values);
  write_chunks(block);
}

// Nulls to NaN, dead traces to NaN, and everything into the statistics, while a trace is in the cache.
void Writing::clean(Block& block, SampleStatistics& statistics) const {
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
void Writing::write_chunks(Block& block) {
  const survey::Box touched = grid_.touched_by(block.box);
  const std::int64_t voxels = grid_.voxels();
  const std::int64_t count = touched.size(2);
  auto* chunks = reinterpret_cast<float*>(block.chunks.get());
  for (std::int64_t c = 0; c < count; ++c) {
    const survey::Index place{touched.lo[0], touched.lo[1], c};
    const survey::Box part = grid_.box_of(place);
    float* chunk = chunks + c * voxels;
    if (part.count() < voxels) std::fill_n(chunk, voxels, 0.0F);
    copy_clean(part, block.box, block.values.data(), grid_.full_box_of(place), chunk, kNull);
    hashes_[static_cast<std::size_t>(grid_.number_of(place))] =
        hash64(std::as_bytes(std::span(chunk, static_cast<std::size_t>(voxels))));
  }
  const std::int64_t first = grid_.number_of({touched.lo[0], touched.lo[1], 0});
  const auto bytes = static_cast<std::size_t>(count * voxels) * sizeof(float);
  output_->write(voxels_at_ + first * voxels * static_cast<std::int64_t>(sizeof(float)),
                 std::span(block.chunks.get(), bytes));
}

// The tables of the layers that are whole, in order.
void Writing::write_finished(std::deque<Layer>& layers) {
  while (!layers.empty() && layers.front().missing.load(std::memory_order_acquire) == 0) {
    const Layer& layer = layers.front();
    live_hash_.add(std::as_bytes(std::span(layer.live)));
    write_slab(live_.id(), H5T_NATIVE_UINT8, {static_cast<hsize_t>(layer.box.lo[0]), 0},
               {static_cast<hsize_t>(layer.box.size(0)), static_cast<hsize_t>(grid_.dims[1])},
               layer.live.data());
    write_min_max(layer.box.hi[0]);
    layers.pop_front();
  }
}

void Writing::write_min_max(std::int64_t next_inline) {
  const survey::Index n = min_max_dims(grid_.dims, 0);
  for (const MinMaxRow& row : min_max_.take_finished(next_inline)) {
    min_max_hash_.add(std::as_bytes(std::span(row)));
    write_slab(level0_.id(), H5T_NATIVE_FLOAT, {static_cast<hsize_t>(min_max_rows_), 0, 0, 0},
               {1, 3, static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[2])}, row.data());
    ++min_max_rows_;
  }
}

void Writing::write_blocks(const BlockSource& fill, const JobContext& job) {
  const survey::Index n = grid_.counts();
  const std::int64_t voxels = grid_.dims[0] * grid_.dims[1] * grid_.dims[2];
  ByteRate rate(voxels * static_cast<std::int64_t>(sizeof(float)));
  std::vector<Block> blocks = make_blocks();
  std::vector<Layer*> layer_of(blocks.size());
  std::deque<Layer> layers;  // those that are not whole yet
  std::int64_t filled = 0;   // voxels
  BlockWorkers workers(statistics_.size(), blocks.size(), [&](std::size_t slot, std::size_t worker) {
    work_on(blocks[slot], statistics_[worker]);
    layer_of[slot]->missing.fetch_sub(1, std::memory_order_release);
  });
  for (std::int64_t bi = 0; bi < n[0]; ++bi) {
    Layer& layer = layers.emplace_back();
    layer.box = grid_.box_of({bi, 0, 0});
    layer.box.hi[1] = grid_.dims[1];
    layer.box.hi[2] = grid_.dims[2];
    layer.live.assign(static_cast<std::size_t>(layer.box.size(0) * layer.box.size(1)), 0);
    layer.missing = n[1];
    for (std::int64_t bj = 0; bj < n[1]; ++bj) {
      job.report(static_cast<double>(filled) / static_cast<double>(voxels), "write",
                 rate.text(filled * static_cast<std::int64_t>(sizeof(float)), ByteRate::Clock::now()));
      const std::size_t slot = workers.take_free();
      write_finished(layers);
      Block& block = blocks[slot];
      block.box = grid_.box_of({bi, bj, 0});
      block.box.hi[2] = grid_.dims[2];
      fill_block(block, layer, fill);
      layer_of[slot] = &layer;
      filled += block.box.count();
      workers.submit(slot);
    }
  }
  workers.finish();
  write_finished(layers);
  job.report(1, "write",
             rate.text(voxels * static_cast<std::int64_t>(sizeof(float)), ByteRate::Clock::now()));
}

void Writing::write_coarser_levels() {
  const int levels = min_max_levels(grid_.dims);
  for (int level = 1; level < levels; ++level) {
    const survey::Index from = min_max_dims(grid_.dims, level - 1);
    const survey::Index n = min_max_dims(grid_.dims, level);
    const Handle finer = open_dataset(file_.id(), fmt::format("{}/{}", kMinMax, level - 1), path_);
    const Extent row_from{1, 3, static_cast<hsize_t>(from[1]), static_cast<hsize_t>(from[2])};
    const Extent row{1, 3, static_cast<hsize_t>(n[1]), static_cast<hsize_t>(n[2])};
    const Handle dataset = create_plain(file_.id(), fmt::format("{}/{}", kMinMax, level), H5T_IEEE_F32LE,
                                        {static_cast<hsize_t>(n[0]), 3, row[2], row[3]});
    Hasher hasher;
    MinMaxRow read = empty_row(from[1] * from[2]);
    for (std::int64_t a = 0; a < n[0]; ++a) {
      MinMaxRow both = empty_row(n[1] * n[2]);
      for (std::int64_t child = 2 * a; child < std::min(2 * a + 2, from[0]); ++child) {
        read_slab(finer.id(), H5T_NATIVE_FLOAT, {static_cast<hsize_t>(child), 0, 0, 0}, row_from,
                  read.data());
        merge_row(both, halved(read, from[1], from[2]));
      }
      hasher.add(std::as_bytes(std::span(both)));
      write_slab(dataset.id(), H5T_NATIVE_FLOAT, {static_cast<hsize_t>(a), 0, 0, 0}, row, both.data());
    }
    write_hash(dataset.id(), hasher.value());
  }
}

void Writing::finish(VolumeInfo& info) {
  write_hash(live_.id(), live_hash_.value());
  write_hash(level0_.id(), min_max_hash_.value());
  write_coarser_levels();

  const auto chunks = static_cast<hsize_t>(grid_.count());
  Handle table = create_plain(file_.id(), kChecksums, H5T_STD_U64LE, {chunks});
  write_slab(table.id(), H5T_NATIVE_UINT64, {0}, {chunks}, hashes_.data());
  info.checksum = hash64(std::as_bytes(std::span(hashes_)));
  for (std::size_t t = 1; t < statistics_.size(); ++t) statistics_.front().merge(statistics_[t]);
  info.statistics = statistics_.front().result(live_traces_);
  for (const auto& [name, text] : describe(info)) write_attribute(file_.id(), name, text);

  const bool closed = table.reset() && level0_.reset() && live_.reset() && voxels_.reset() && file_.reset();
  if (!closed) throw_hdf5(ErrorCode::kIo, "cannot write the volume's tables", "is the disk full?");
  info.bytes = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  write_preamble(path_, {info.bytes, voxels_at_, grid_});
}

}  // namespace

survey::Index default_chunk(const survey::Index& dims) {
  survey::Index chunk;
  for (int axis = 0; axis < 3; ++axis) chunk[axis] = std::min(dims[axis], kDefaultSide);
  while (block_bytes(dims, chunk) > kDefaultBlockBytes && std::max(chunk[0], chunk[1]) > 8) {
    std::int64_t& longer = chunk[0] > chunk[1] ? chunk[0] : chunk[1];
    longer = std::max<std::int64_t>(8, longer / 2);
  }
  return chunk;
}

VolumeInfo write_volume(const std::filesystem::path& path, const WriteOptions& options,
                        const BlockSource& fill, const JobContext& job) {
  quiet_hdf5();
  options.geometry.validate();
  VolumeInfo info;
  info.geometry = options.geometry;
  info.dims = options.geometry.dims();
  info.origin = options.origin;
  if (options.null_value && !std::isnan(*options.null_value)) info.null_value = options.null_value;
  info.role = options.role;
  info.high_is_fault = options.high_is_fault;
  info.source = options.source;
  info.provenance_json = options.provenance_json;
  info.chunk = checked_chunk(options);
  describe(info);  // what cannot be stored is refused before hours of import, not after

  PartialFile file(path);
  {
    Writing writing(file.path(), info);
    writing.write_blocks(fill, job.part(0, 0.98));
    writing.finish(info);
  }
  job.check();
  file.commit();
  job.report(1, "write");
  return info;
}

}  // namespace footwall::volume
