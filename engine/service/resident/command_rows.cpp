#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"

namespace footwall::service {

std::span<const CommandRow> command_rows() {
  using Command = v1::Command;
  static constexpr CommandRow kRows[] = {
      {Command::kOpenVolume, "open_volume", open_volume},
      {Command::kCloseVolume, "close_volume", close_volume},
      {Command::kEditModel, "edit_model", edit_model},
      {Command::kReadModel, "read_model", read_model},
      {Command::kExtract, "extract", extract},
      {Command::kLive, "live", live},
      {Command::kFaceVoxels, "face_voxels", face_voxels},
      {Command::kIsosurface, "isosurface", isosurface},
      {Command::kRender, "render", render},
      {Command::kTask, "run_task", run_task},
  };
  return kRows;
}

}  // namespace footwall::service
