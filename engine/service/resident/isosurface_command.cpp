// Isosurfaces of open volumes.
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/drawn_volume.h"
#include "engine/service/resident/jobs/surface_stream.h"

namespace footwall::service {

void isosurface(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const v1::IsosurfaceRequest& request = command.isosurface();
  send_isosurface(state.world, drawn_volume(state, request.volume()).samples(), request, state.threads, send,
                  job);
}

}  // namespace footwall::service
