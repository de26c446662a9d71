// The voxels of one triangle.
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/jobs/face_values.h"
#include "engine/service/resident/resident_state.h"

namespace footwall::service {

void face_voxels(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const v1::FaceVoxelsRequest& request = command.face_voxels();
  OpenVolume& volume = *state.world.collectively([&] { return &state.volumes.find(request.volume()); });
  send_face_values(state.world, *volume.survey, volume.info, request, state.threads, send, job);
}

}  // namespace footwall::service
