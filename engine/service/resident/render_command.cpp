// Pictures of isosurfaces of open volumes.
#include <fmt/format.h>

#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/drawn_volume.h"
#include "engine/service/resident/jobs/picture_stream.h"
#include "storage/base/hash.h"

namespace footwall::service {
namespace {

constexpr const char* kKept = "drawn";

}  // namespace

session::DrawnVolume& drawn_volume(ResidentState& state, const std::string& checksum) {
  OpenVolume& volume = *state.world.collectively([&] { return &state.volumes.find(checksum); });
  if (const auto found = volume.kept.find(kKept); found != volume.kept.end())
    return *std::static_pointer_cast<session::DrawnVolume>(found->second);
  const auto made = std::make_shared<session::DrawnVolume>(state.world, volume.path);
  state.world.collectively([&] {
    if (made->samples().info().checksum == volume.info.checksum) return;
    throw Error(ErrorCode::kInvalid,
                fmt::format("the volume {} has checksum {} by now, not {}", volume.path.string(),
                            to_hex(made->samples().info().checksum), checksum),
                "close it, and open it again");
  });
  volume.kept.emplace(kKept, made);
  return *made;
}

void render(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const v1::RenderRequest& request = command.render();
  // Volumes are told apart by their checksums.
  const session::RenderJob wanted = state.world.collectively([&] {
    const auto open = [&](const std::string& checksum) -> std::filesystem::path {
      return state.volumes.find(checksum).checksum;
    };
    return render_job_of(request, open, state.threads);
  });
  const auto volume_of = [&](const std::filesystem::path& checksum) -> session::DrawnVolume& {
    return drawn_volume(state, checksum.string());
  };
  send_picture(state.world, wanted, request.visible().every_pass(), volume_of, send, job);
}

}  // namespace footwall::service
