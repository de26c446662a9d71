// Reads a volume into the ranks' memory, and tells beforehand how much of it.
#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/extract.h"
#include "storage/base/job_context.h"
#include "storage/volume/volume_info.h"

namespace footwall::service {

class VolumeLoader {
 public:
  // Looks at the file. Collective; throws, on all ranks, what VolumeReader throws.
  VolumeLoader(const comm::Communicator& world, const std::filesystem::path& path);
  ~VolumeLoader();
  VolumeLoader(const VolumeLoader&) = delete;
  VolumeLoader& operator=(const VolumeLoader&) = delete;

  const volume::VolumeInfo& info() const;
  // Of each rank: its voxels with their halo; and what reading takes besides.
  std::vector<std::int64_t> bytes_that_stay() const;
  std::vector<std::int64_t> bytes_that_pass() const;
  // Collective; cancelled within some 8 MiB of reading. Throws kMemory, kCorrupt, kCancelled.
  std::unique_ptr<extract::LoadedSurvey> load(const JobContext& job);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::service
