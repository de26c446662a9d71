#include "engine/service/resident/open_volumes.h"

#include <fmt/format.h>

#include <numeric>

#include "engine/comm/shared_text.h"
#include "engine/service/engine.pb.h"
#include "engine/service/resident/load_volume.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_reader.h"

namespace footwall::service {
namespace {

Error not_open(const std::string& checksum) {
  return {ErrorCode::kNotFound, fmt::format("volume '{}' is not open", checksum),
          "open it first; footwall status lists the open ones"};
}

}  // namespace

std::int64_t OpenVolume::memory_bytes() const {
  return std::accumulate(rank_bytes.begin(), rank_bytes.end(), std::int64_t{0});
}

OpenVolumes::OpenVolumes(const comm::Communicator& world, const std::filesystem::path& folder,
                         const HostMemory& memory)
    : world_(world), folder_(folder), memory_(memory) {}

std::filesystem::path OpenVolumes::file_of(const std::string& checksum) {
  const auto open = volumes_.find(checksum);
  if (open != volumes_.end()) return open->second->path;
  if (auto found = folder_.find(checksum)) return *found;
  throw Error(
      ErrorCode::kNotFound,
      folder_.path().empty()
          ? fmt::format("volume '{}' is not open, and the engine was given no folder of volumes", checksum)
          : fmt::format("volume '{}' is neither open nor in {}", checksum, folder_.path().string()),
      "open it by its path, or start the engine with --volumes DIR");
}

OpenVolumes::Found OpenVolumes::locate_here(const v1::VolumeName& name) {
  if (name.path().empty()) {
    if (name.checksum().empty())
      throw Error(ErrorCode::kUsage, "the volume has no name", "give its checksum or path");
    return {file_of(name.checksum()), name.checksum()};
  }
  const std::filesystem::path path = name.path();
  if (!path.is_absolute()) {
    throw Error(ErrorCode::kUsage, fmt::format("the volume's path '{}' is not absolute", path.string()),
                "give the whole path on the engine's machine, from /");
  }
  const std::string checksum = to_hex(volume::VolumeReader(path).info().checksum);
  if (!name.checksum().empty() && name.checksum() != checksum) {
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("the volume {} has checksum {}, not {}", path.string(), checksum, name.checksum()),
        "give the file that was meant, or leave out the checksum");
  }
  return {path, checksum};
}

OpenVolumes::Found OpenVolumes::locate(const v1::VolumeName& name) {
  const Found found = world_.collectively([&] { return world_.rank() == 0 ? locate_here(name) : Found(); });
  return {comm::shared_text(world_, found.path.string()), comm::shared_text(world_, found.checksum)};
}

std::int64_t OpenVolumes::bytes_of(int rank) const {
  std::int64_t bytes = 0;
  for (const auto& [checksum, volume] : volumes_) bytes += volume->rank_bytes[static_cast<std::size_t>(rank)];
  return bytes;
}

std::int64_t OpenVolumes::kept_bytes() const {
  std::int64_t bytes = 0;
  for (const auto& [checksum, volume] : volumes_) {
    for (const auto& [name, kept] : volume->kept) bytes += kept->memory_bytes();
  }
  return bytes;
}

void OpenVolumes::drop_kept() {
  for (const auto& [checksum, volume] : volumes_) volume->kept.clear();
}

OpenVolume& OpenVolumes::open(const v1::VolumeName& name, const JobContext& job) {
  // 1 Where is it? What is open already is quick also where the request names it by checksum alone.
  if (name.path().empty()) {
    const auto open = volumes_.find(name.checksum());
    if (open != volumes_.end()) return *open->second;
  }
  const Found found = locate(name);
  const auto open = volumes_.find(found.checksum);
  if (open != volumes_.end()) return *open->second;

  // 2 Is there room?
  VolumeLoader loader(world_, found.path);
  world_.collectively([&] {
    if (to_hex(loader.info().checksum) != found.checksum) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("the volume {} changed while it was opened", found.path.string()),
                  "open it again when it is whole");
    }
  });
  const auto rank = static_cast<std::size_t>(world_.rank());
  memory_.require_free(loader.bytes_that_stay()[rank] + loader.bytes_that_pass()[rank],
                       fmt::format("the volume {}", found.path.string()),
                       "close other volumes, or use more hosts or a smaller volume");

  // 3 Each rank reads its part.
  auto volume = std::make_unique<OpenVolume>();
  volume->checksum = found.checksum;
  volume->path = found.path;
  volume->info = loader.info();
  volume->rank_bytes = loader.bytes_that_stay();
  volume->survey = loader.load(job);
  return *volumes_.emplace(found.checksum, std::move(volume)).first->second;
}

OpenVolume& OpenVolumes::find(const std::string& checksum) {
  const auto found = volumes_.find(checksum);
  if (found == volumes_.end()) throw not_open(checksum);
  return *found->second;
}

void OpenVolumes::close(const std::string& checksum) {
  if (volumes_.erase(checksum) == 0) throw not_open(checksum);
}

std::uint64_t OpenVolumes::hash() const {
  Hasher hasher;
  for (const auto& [checksum, volume] : volumes_) hasher.add(std::as_bytes(std::span(checksum)));
  return hasher.value();
}

}  // namespace footwall::service
