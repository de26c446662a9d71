// The commands of an engine whose last rank, alone, counts an edit after each attribute volume: what a defect
// would do. Linked in the place of engine/service/resident/command_rows.cpp into an engine for
// differing_ranks_test.py.
#include <array>

#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/resident_state.h"

namespace footwall::service {
namespace {

void run_task_and_differ(ResidentState& state, const v1::Command& command, const Send& send,
                         const JobContext& job) {
  run_task(state, command, send, job);
  if (command.task().task().kind() == "attribute" && state.world.rank() == state.world.size() - 1)
    state.model.apply(v1::EditBatch());
}

}  // namespace

std::span<const CommandRow> command_rows() {
  static constexpr std::array kRows{
      CommandRow{v1::Command::kOpenVolume, "open_volume", open_volume},
      CommandRow{v1::Command::kEditModel, "edit_model", edit_model},
      CommandRow{v1::Command::kTask, "run_task", run_task_and_differ},
  };
  return kRows;
}

}  // namespace footwall::service
