// footwall export: faces with the statistics of a run.
#include "app/footwall/commands/export_parts.h"
#include "engine/tasks/face_tables.h"
#include "storage/base/log.h"
#include "storage/formats/faces_csv.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/vtp.h"

namespace footwall::commands {

void ExportFaces::add_to(CLI::App& command) {
  command.add_option("--vtp", vtp, "Faces and statistics for ParaView (VTK XML PolyData, z positive up)");
  command.add_option("--tsurf", tsurf, "Meshes as GOCAD TSurf (z positive down)");
  command.add_option("--csv", csv, "Faces and statistics as a table (z positive down)");
  command
      .add_option("--properties", properties, "TSurf: statistics to write at the vertices, comma separated")
      ->delimiter(',');
  command.add_flag("--strict", strict, "TSurf: the narrow form that RMS reads");
}

void ExportFaces::run(const project::Project& project, const ExportChoice& choice,
                      console::Output& output) const {
  const tasks::FaceTables faces =
      tasks::face_tables(project, choice.fault, choice.run, tasks::Coordinates::kWorld, choice.z_unit);
  if (faces.tables.empty())
    throw Error(ErrorCode::kInvalid, "there are no faces to export", "footwall triangulate makes them");
  for (const std::string& name : faces.stale)
    log::warn(name + " was edited since this run: the run's faces are exported");
  if (!vtp.empty()) {
    formats::vtp::Options how;
    how.z_axis = choice.z_up(true) ? formats::vtp::ZAxis::kUp : formats::vtp::ZAxis::kDown;
    how.horizontal_unit = faces.units.horizontal;
    how.vertical_unit = faces.units.vertical;
    how.crs = faces.crs;
    formats::vtp::write(vtp, faces.tables, how);
    add_file(output, vtp);
  }
  if (!tsurf.empty()) {
    formats::gocad_tsurf::WriteOptions how;
    how.horizontal_unit = faces.units.horizontal;
    how.vertical_unit = faces.units.vertical;
    how.z_positive_up = choice.z_up(false);
    how.properties = properties;
    how.strict = strict;
    add_renamed(output, formats::gocad_tsurf::write(tsurf, faces.tables, how));
    add_file(output, tsurf);
  }
  if (!csv.empty()) {
    formats::faces_csv::write(csv, faces.tables,
                              formats::faces_csv::Declared{faces.units.horizontal, faces.units.vertical,
                                                           choice.z_up(false), faces.crs});
    add_file(output, csv);
  }
}

}  // namespace footwall::commands
