// The volumes that are in memory, each rank its part, and how they are found.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/extract.h"
#include "engine/service/resident/host_memory.h"
#include "engine/service/resident/volume_folder.h"
#include "engine/service/resident_status.h"
#include "storage/base/job_context.h"
#include "storage/volume/volume_info.h"

namespace footwall::v1 {
class VolumeName;
}

namespace footwall::service {

// What a command keeps of a volume.
class Kept {
 public:
  Kept() = default;
  virtual ~Kept() = default;
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;
  virtual std::int64_t memory_bytes() const = 0;  // of this rank
};

struct OpenVolume {
  std::string checksum;  // 16 hex digits: its name in requests
  std::filesystem::path path;
  volume::VolumeInfo info;
  std::unique_ptr<extract::LoadedSurvey> survey;
  std::vector<std::int64_t> rank_bytes;  // that stay in memory, of each rank
  // What commands keep for the next of their kind; gone when the volume is closed, and where memory is short.
  // No part of the state hash.
  std::map<std::string, std::shared_ptr<Kept>> kept;

  std::int64_t memory_bytes() const;  // of all ranks
};

class OpenVolumes {
 public:
  // folder: where volumes are found by checksum, may be empty. memory stays. Not collective.
  OpenVolumes(const comm::Communicator& world, const std::filesystem::path& folder, const HostMemory& memory);

  // Where a volume is, and that it is the right one. Collective. Throws kNotFound, kUsage (a name that is
  // none, a path that is not absolute), kInvalid (another checksum), and what VolumeReader throws.
  struct Found {
    std::filesystem::path path;
    std::string checksum;
  };
  Found locate(const v1::VolumeName& name);

  // The same on rank 0 alone.
  Found locate_here(const v1::VolumeName& name);

  // Loads it, or finds it open. Collective. Throws as locate(), kMemory with what it needs and what is free
  // before anything is read, kCancelled.
  OpenVolume& open(const v1::VolumeName& name, const JobContext& job);
  // Not collective, alike on every rank. Throw kNotFound.
  OpenVolume& find(const std::string& checksum);
  void close(const std::string& checksum);

  const std::map<std::string, std::unique_ptr<OpenVolume>>& all() const { return volumes_; }
  // Rank 0 alone: the file of a volume that is open or in the folder. Throws kNotFound.
  std::filesystem::path file_of(const std::string& checksum);
  std::uint64_t hash() const;

  // Voxels of a rank in memory; what is kept besides on this one.
  std::int64_t bytes_of(int rank) const;
  std::int64_t kept_bytes() const;
  // Not collective, alike on every rank.
  void drop_kept();

 private:
  const comm::Communicator& world_;
  VolumeFolder folder_;
  const HostMemory& memory_;
  std::map<std::string, std::unique_ptr<OpenVolume>> volumes_;
};

}  // namespace footwall::service
