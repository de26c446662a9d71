// Pictures of isosurfaces of open volumes.
#include <fmt/format.h>

#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/drawn_volume.h"
#include "engine/service/resident/jobs/picture_stream.h"
#include "engine/service/resident/memory_needs.h"
#include "storage/base/hash.h"

namespace footwall::service {
namespace {

constexpr const char* kKept = "drawn";

}  // namespace

std::int64_t DrawnKept::memory_bytes() const {
  return drawn.memory_bytes() + sent.memory_bytes();
}

DrawnKept& drawn_volume(ResidentState& state, const std::string& checksum) {
  OpenVolume& volume = *state.world.collectively([&] { return &state.volumes.find(checksum); });
  if (const auto found = volume.kept.find(kKept); found != volume.kept.end())
    return *std::static_pointer_cast<DrawnKept>(found->second);
  const auto made = std::make_shared<DrawnKept>(state.world, volume.path);
  state.world.collectively([&] {
    if (made->drawn.samples().info().checksum == volume.info.checksum) return;
    throw Error(ErrorCode::kInvalid,
                fmt::format("the volume {} has checksum {} by now, not {}", volume.path.string(),
                            to_hex(made->drawn.samples().info().checksum), checksum),
                "close it, and open it again");
  });
  volume.kept.emplace(kKept, made);
  return *made;
}

namespace {

// What this rank needs for a picture beside what it has.
std::int64_t needed(ResidentState& state, const session::RenderJob& job) {
  const int ranks = state.world.size();
  std::int64_t bytes = 0;
  std::int64_t triangles = 0;
  for (const session::RenderJob::Isosurface& each : job.isosurfaces) {
    session::DrawnVolume& drawn = drawn_volume(state, each.volume.string()).drawn;
    const survey::Index& dims = drawn.samples().info().dims;
    const std::int64_t some = expected_triangles(drawn.samples().bricks(), each.value);
    triangles += some;
    if (!job.visible) {
      if (!drawn.has_whole(each.value, job.interleave)) bytes += surface_extraction_bytes(some, dims, ranks);
    } else if (!drawn.visible().has_samples()) {
      bytes += visible_sample_bytes(dims, ranks);
    }
  }
  return bytes + picture_bytes(triangles, std::int64_t{job.width} * job.height, state.world.rank(), ranks);
}

}  // namespace

void render(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const v1::RenderRequest& request = command.render();
  // Volumes are told apart by their checksums.
  const session::RenderJob wanted = state.world.collectively([&] {
    const auto open = [&](const std::string& checksum) -> std::filesystem::path {
      return state.volumes.find(checksum).checksum;
    };
    return render_job_of(request, open, state.threads);
  });
  state.memory.require_free(needed(state, wanted), "the picture",
                            "give it fewer pixels or isosurfaces, or close volumes that are not needed");
  const auto volume_of = [&](const std::filesystem::path& checksum) -> session::DrawnVolume& {
    return drawn_volume(state, checksum.string()).drawn;
  };
  send_picture(state.world, wanted, request.visible().every_pass(), volume_of, send, job);
  // What was read last is of no use to the next picture.
  for (const session::RenderJob::Isosurface& each : wanted.isosurfaces)
    volume_of(each.volume).samples().release();
}

}  // namespace footwall::service
