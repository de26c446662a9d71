// footwall export: the voxel values that a run kept of its faces.
#include "app/footwall/commands/export_parts.h"
#include "engine/tasks/face_voxels.h"
#include "storage/base/error.h"
#include "storage/formats/voxels_csv.h"
#include "storage/formats/z_unit.h"

namespace footwall::commands {

void ExportFaceVoxels::add_to(CLI::App& command) {
  command.add_option(
      "--face-voxels", file,
      "The voxels of each face as a table, of a run that computed voxels, lot or filter (z positive down)");
}

void ExportFaceVoxels::run(const project::Project& project, const ExportChoice& choice,
                           const console::Console& console, console::Output& output) const {
  const auto survey = project.survey();
  if (!survey) {
    throw Error(ErrorCode::kInvalid, "the project has no survey, and so no voxels",
                "footwall import volume brings one");
  }
  formats::voxels_csv::Depth depth;
  depth.up = choice.z_up(false);
  if (!choice.z_unit.empty())
    depth.factor = formats::z_unit_factor(name_of(survey->vertical_unit), choice.z_unit);
  formats::voxels_csv::Writer writer(file, *survey, depth);
  const tasks::FaceVoxelsRead read = tasks::read_face_voxels(
      project, choice.fault, choice.run,
      [&](const tasks::VoxelsOfFace& face) { writer.add(face.fault, face.face, face.voxels, face.values); },
      console.job());
  writer.commit();
  add_file(output, file);
  output.json["face_voxels"] = {
      {"run", read.run}, {"codec", read.codec}, {"faces", read.faces}, {"voxels", read.voxels}};
}

}  // namespace footwall::commands
