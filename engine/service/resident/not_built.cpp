// Commands that this engine does not carry out yet.
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/resident_state.h"

namespace footwall::service {
namespace {

[[noreturn]] void refuse(const ResidentState& state, const char* what) {
  const Error error(ErrorCode::kUnsupported, std::string(what) + " is not built into this engine",
                    "do it without --engine");
  state.world.collectively([&] { throw Error(error); });
  throw error;
}

}  // namespace

void face_voxels(ResidentState& state, const v1::Command&, const Send&, const JobContext&) {
  refuse(state, "reading a face's voxels");
}
void isosurface(ResidentState& state, const v1::Command&, const Send&, const JobContext&) {
  refuse(state, "extracting an isosurface");
}
void render(ResidentState& state, const v1::Command&, const Send&, const JobContext&) {
  refuse(state, "drawing pictures");
}
void run_task(ResidentState& state, const v1::Command&, const Send&, const JobContext&) {
  refuse(state, "running jobs of the command line");
}
void read_box(ResidentState&, const v1::ReadBoxRequest&, const Send&) {
  throw Error(ErrorCode::kUnsupported, "reading a box of a volume is not built into this engine",
              "read the volume's file itself");
}

}  // namespace footwall::service
