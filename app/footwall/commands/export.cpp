// footwall export: volumes and faces in other programs' formats.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/export_volume.h"
#include "engine/tasks/face_tables.h"
#include "storage/base/log.h"
#include "storage/formats/faces_csv.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/vtp.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, volume, raw, vtp, tsurf, csv, fault, z_positive;
  std::optional<std::int64_t> run;
  std::vector<std::string> properties;
  bool strict = false;
};

bool z_up(const Options& options, bool otherwise) {
  return options.z_positive.empty() ? otherwise : options.z_positive == "up";
}

void export_faces(const Options& options, const project::Project& project, console::Output& output) {
  const survey::Geometry survey = project.survey().value_or(survey::Geometry{});
  const tasks::FaceTables faces =
      tasks::face_tables(project, options.fault, options.run, tasks::Coordinates::kWorld);
  if (faces.tables.empty())
    throw Error(ErrorCode::kInvalid, "there are no faces to export", "footwall triangulate makes them");
  for (const std::string& name : faces.stale)
    log::warn(name + " was edited since this run: the run's faces are exported");
  const auto written = [&](const std::string& file) {
    output.json["files"].push_back(file);
    output.text += "written " + file + "\n";
  };
  if (!options.vtp.empty()) {
    formats::vtp::write(options.vtp, faces.tables,
                        {z_up(options, true) ? formats::vtp::ZAxis::kUp : formats::vtp::ZAxis::kDown,
                         std::string(name_of(survey.vertical_unit)), survey.crs});
    written(options.vtp);
  }
  if (!options.tsurf.empty()) {
    formats::gocad_tsurf::WriteOptions how;
    how.horizontal_unit = survey.horizontal_unit;
    how.vertical_unit = name_of(survey.vertical_unit);
    how.z_positive_up = z_up(options, false);
    how.properties = options.properties;
    how.strict = options.strict;
    formats::gocad_tsurf::write(options.tsurf, faces.tables, how);
    written(options.tsurf);
  }
  if (!options.csv.empty()) {
    formats::faces_csv::write(options.csv, faces.tables);
    written(options.csv);
  }
}

console::Output run(const Options& options, const console::Console& console) {
  const bool faces = !options.vtp.empty() || !options.tsurf.empty() || !options.csv.empty();
  if (!faces && options.raw.empty()) {
    throw Error(ErrorCode::kUsage, "nothing to export", "name a file with --raw, --vtp, --tsurf or --csv");
  }
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  console::Output output{{{"files", console::Json::array()}}, ""};
  if (!options.raw.empty()) {
    const std::int64_t samples = tasks::export_raw(project, options.volume, options.raw, console.job());
    output.json["files"].push_back(options.raw);
    output.json["samples"] = samples;
    output.text += fmt::format("written {}: {} float32 samples, little-endian, [inline][crossline][sample]\n",
                               options.raw, samples);
  }
  if (faces) export_faces(options, project, output);
  return output;
}

}  // namespace

void add_export(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "export", "Write volumes and faces in other programs' formats",
                                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--volume", options->volume, "The volume for --raw (default: the first)");
  command->add_option("--raw", options->raw, "Samples as float32 little-endian, [inline][crossline][sample]");
  command->add_option("--vtp", options->vtp,
                      "Faces and statistics for ParaView (VTK XML PolyData, z positive up)");
  command->add_option("--tsurf", options->tsurf, "Meshes as GOCAD TSurf (z positive down)");
  command->add_option("--csv", options->csv, "Faces and statistics as a table");
  command->add_option("--fault", options->fault, "Only this fault (default: all)");
  command->add_option("--run", options->run, "Statistics of this run (default: the last)");
  command
      ->add_option("--z-positive", options->z_positive, "Turn z: up or down, whatever the format's default")
      ->check(CLI::IsMember({"up", "down"}));
  command
      ->add_option("--properties", options->properties,
                   "TSurf: statistics to write at the vertices, comma separated")
      ->delimiter(',');
  command->add_flag("--strict", options->strict, "TSurf: the narrow form that RMS reads");
}

}  // namespace footwall::commands
