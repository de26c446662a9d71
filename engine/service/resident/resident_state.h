// What stays on every rank between commands. Alike on all of them, but for the voxels.
#pragma once
#include <map>
#include <memory>
#include <string>

#include "engine/service/resident/extractions.h"
#include "engine/service/resident/face_model.h"
#include "engine/service/resident/memory_needs.h"
#include "engine/service/resident/open_volumes.h"

namespace footwall::service {

class ResidentState {
 public:
  // threads: of each rank. host_of: of each rank, the lowest rank of its host.
  ResidentState(comm::Communicator& its_world, int its_threads, const std::filesystem::path& volume_folder,
                const std::vector<int>& its_host_of, std::int64_t host_bytes)
      : world(its_world),
        threads(its_threads),
        host_of(its_host_of),
        memory(its_world, its_host_of, host_bytes),
        volumes(its_world, volume_folder, memory) {
    memory.held = [this]() -> HostMemory::Held {
      return {volumes.bytes_of(world.rank()) + model_bytes(static_cast<std::int64_t>(model.faces().size())) +
                  extractions.memory_bytes(),
              volumes.kept_bytes()};
    };
    memory.drop = [this] { volumes.drop_kept(); };
  }
  ResidentState(const ResidentState&) = delete;
  ResidentState& operator=(const ResidentState&) = delete;

  comm::Communicator& world;
  int threads;
  std::vector<int> host_of;
  HostMemory memory;
  OpenVolumes volumes;
  FaceModel model;
  Extractions extractions;  // before volumes are closed, they go
  // What commands keep for the next of their kind, e.g. files that stay open. No part of the hash.
  std::map<std::string, std::shared_ptr<void>> kept;

  std::uint64_t hash() const { return model.hash() * 31 + volumes.hash(); }
};

}  // namespace footwall::service
