// Boxes of volumes, on rank 0 alone.
#include "engine/service/engine.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/jobs/box_reads.h"
#include "engine/service/resident/resident_state.h"

namespace footwall::service {

void read_box(ResidentState& state, const v1::ReadBoxRequest& request, const Send& send) {
  std::shared_ptr<void>& kept = state.kept["box reads"];
  if (!kept) kept = std::make_shared<BoxReads>();
  // Readers stay open, but not for volumes that this engine has no more.
  std::filesystem::path file = state.volumes.file_of(request.volume());
  std::static_pointer_cast<BoxReads>(kept)->read(
      request, [&](const std::string&) { return file; }, send);
}

}  // namespace footwall::service
