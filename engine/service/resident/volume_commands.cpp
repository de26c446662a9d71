// Opening and closing volumes.
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/resident_state.h"
#include "engine/service/wire.h"

namespace footwall::service {

void open_volume(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const std::size_t before = state.volumes.all().size();
  const OpenVolume& volume = state.volumes.open(command.open_volume().volume(), job.part(0, 0.99));
  const std::string checksum = volume.checksum;
  const bool is_new = state.volumes.all().size() != before;
  try {
    state.world.collectively([&] {
      if (state.world.rank() != 0) return;
      v1::OpenVolumeReply reply;
      v1::OpenVolumeInfo& info = *reply.mutable_opened();
      info.set_volume(volume.checksum);
      info.set_path(volume.path.string());
      *info.mutable_dims() = message_of(volume.info.dims);
      info.set_memory_bytes(volume.memory_bytes());
      send(reply);
    });
  } catch (const comm::AgreedError&) {
    if (is_new) state.volumes.close(checksum);
    throw;
  }
}

void close_volume(ResidentState& state, const v1::Command& command, const Send& send,
                  const JobContext& /*job*/) {
  const std::string& checksum = command.close_volume().volume();
  state.world.collectively([&] {
    state.volumes.find(checksum);
    if (state.world.rank() == 0) send(v1::CloseVolumeReply());
  });
  state.extractions.forget(checksum);
  state.volumes.close(checksum);
}

}  // namespace footwall::service
