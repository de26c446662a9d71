// Jobs of the command line.
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/jobs/run_stored_task.h"
#include "engine/service/resident/resident_state.h"

namespace footwall::service {

void run_task(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  run_stored_task(
      state.world, command.task(),
      [&](const v1::VolumeName& name) { return state.volumes.locate_here(name).path; }, state.threads, send,
      job);
}

}  // namespace footwall::service
