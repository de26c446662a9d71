#include "storage/volume/volume_writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "storage/base/byte_rate.h"
#include "storage/base/partial_file.h"
#include "storage/volume/block_writer.h"
#include "storage/volume/checked_options.h"
#include "storage/volume/volume_tables.h"

namespace footwall::volume {

VolumeInfo write_volume(const std::filesystem::path& path, const WriteOptions& options,
                        const BlockSource& fill, const JobContext& job) {
  VolumeInfo info = checked(options);
  const ChunkGrid grid{info.dims, info.chunk};
  PartialFile file(path);
  {
    VolumeTables tables(file.path(), grid);
    BlockWriter blocks(file.path(), tables.voxels_at(), grid, info.null_value, all_blocks(grid));
    const JobContext part = job.part(0, 0.98);
    const std::int64_t voxels = grid.dims[0] * grid.dims[1] * grid.dims[2];
    constexpr std::int64_t kBytes = sizeof(float);
    ByteRate rate(voxels * kBytes);
    const auto report = [&](std::int64_t done) {
      part.report(static_cast<double>(done) / static_cast<double>(voxels), "write",
                  rate.text(done * kBytes, ByteRate::Clock::now()));
    };
    blocks.write(fill, report, [&](const survey::Box& layer, std::span<const std::uint8_t> mask) {
      tables.add_live(layer, mask);
      for (const MinMaxRow& row : blocks.take_finished(layer.hi[0])) tables.add_min_max(row);
    });
    report(voxels);
    tables.finish(info, blocks.hashes(), blocks.statistics());
  }
  job.check();
  file.commit();
  job.report(1, "write");
  return info;
}

}  // namespace footwall::volume
