// Boxes of volumes, read by one rank alone from the volumes' files, between the slices of what all ranks do.
#pragma once
#include <filesystem>
#include <functional>
#include <list>
#include <string>

#include "engine/service/engine.pb.h"
#include "engine/service/resident/jobs/send.h"
#include "storage/volume/volume_reader.h"

namespace footwall::service {

// The file of a volume, by its checksum. Throws Error kNotFound.
using VolumePath = std::function<std::filesystem::path(const std::string& checksum)>;

// Readers stay open from box to box.
class BoxReads {
 public:
  // Sends ReadBoxReply pieces of at most 4 MiB of values, in order. Throws Error kUsage for a box that is
  // empty or leaves the volume, kMemory for one of more than 256 MiB, kInvalid where the file is another one
  // by now, kCancelled from send, and what VolumeReader throws.
  void read(const v1::ReadBoxRequest& request, const VolumePath& path_of, const Send& send);

 private:
  struct Open {
    std::string checksum;
    volume::VolumeReader reader;
  };
  const volume::VolumeReader& reader_of(const std::string& checksum, const VolumePath& path_of);

  std::list<Open> open_;  // the last one used in front
};

}  // namespace footwall::service
