#include "engine/tasks/export_petrel.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <system_error>

#include "engine/tasks/export_sticks.h"
#include "engine/tasks/face_tables.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/points_table.h"
#include "storage/formats/stick_formats.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

std::string domain_line(const std::optional<survey::Geometry>& survey) {
  if (!survey) return "not known: the project has no survey, coordinates are those of the imported files";
  return survey->domain == survey::Domain::kTime ? "time (two-way)" : "depth";
}

std::string note(const project::Project& project, const FaceTables& faces, const PetrelOptions& options,
                 bool sticks, bool tables) {
  const auto survey = project.survey();
  std::string text = fmt::format(
      "Faults of {}, written by Footwall for Petrel\n\n"
      "Domain           {}\n"
      "Unit of z        {}\n"
      "Sign of z        positive {}\n"
      "Unit of X and Y  {}\n"
      "CRS              {}\n\n"
      "Set these for the project, or in the import dialogues, before loading: the text formats do not carry "
      "them.\n",
      project.path().filename().string(), domain_line(survey),
      survey || !faces.tables.empty() ? faces.units.vertical : "not known: as imported",
      options.z_positive_up ? "up (elevation; below the datum z is negative)"
                            : "down (below the datum z is positive)",
      faces.units.horizontal, faces.crs.empty() ? "not stated" : faces.crs);
  if (sticks) {
    text += fmt::format(
        "\nfault_sticks.txt\n"
        "  Fault sticks, Charisma format: marker, inline, crossline, X, Y, Z, fault name, stick number.\n"
        "  Import as a file of type 'Charisma fault sticks (ASCII)'.{}\n",
        survey ? "" : " Inline and crossline are 0: the project has no survey.");
  }
  if (tables) {
    text += fmt::format(
        "\nface_points.txt\n"
        "  One point a triangle, at its centroid, with the attributes of {}. The first row names the "
        "columns: X, Y,\n"
        "  Z, fault, face, then the attributes. Import as points with attributes, 1 header row, columns "
        "parted by\n"
        "  blanks, undefined value {}.\n"
        "\nfaults.ts\n"
        "  The triangle meshes as GOCAD TSurf, with units and sign of z declared in the file. Petrel needs a "
        "reader of\n"
        "  GOCAD surfaces for it; other programs of this trade have one.\n",
        faces.run ? faces.run->name : "no run (footwall extract computes them)",
        formats::points_table::kUndefined);
  }
  return text;
}

}  // namespace

PetrelExport export_petrel(const project::Project& project, const fs::path& folder,
                           const PetrelOptions& options) {
  // 1. Everything that can be refused, before a file is written.
  const FaceTables faces =
      face_tables(project, options.fault, options.run, Coordinates::kWorld, options.z_unit);
  SticksChoice choice;
  choice.fault = options.fault;
  choice.z_positive_up = options.z_positive_up;
  choice.names_without_blanks = true;
  const bool survey = project.survey().has_value();
  if (survey) choice.z_unit = options.z_unit;
  const ProjectSticks sticks = project_sticks(project, choice);
  if (!survey && !sticks.sticks.empty() && !options.z_unit.empty()) {
    throw Error(ErrorCode::kUsage, "without a survey the unit of the pillars' z is not known",
                "leave --z-unit out, or choose an imported surface with --fault");
  }
  if (sticks.sticks.empty() && faces.tables.empty()) {
    throw Error(ErrorCode::kInvalid, "there are neither pillars nor faces to export",
                "footwall import sticks, import surface and triangulate make them");
  }
  PetrelExport done;
  for (const std::string& name : faces.stale)
    done.notices.push_back(name + " was edited since this run: the run's faces are exported");
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  if (trouble) throw io_error("make the folder", folder.string(), trouble.value());
  const auto path_of = [&](const char* name) {
    done.files.push_back((folder / name).string());
    return folder / name;
  };

  // 2. What the interpreter picked.
  if (!sticks.sticks.empty())
    done.renamed = formats::write_sticks(path_of("fault_sticks.txt"), "charisma", sticks.sticks, sticks.how);

  // 3. What was computed, and the meshes.
  if (!faces.tables.empty()) {
    const auto renamed =
        formats::points_table::write(path_of("face_points.txt"), faces.tables, options.z_positive_up);
    done.renamed.insert(done.renamed.end(), renamed.begin(), renamed.end());
    formats::gocad_tsurf::WriteOptions how;
    how.horizontal_unit = faces.units.horizontal;
    how.vertical_unit = faces.units.vertical;
    how.z_positive_up = options.z_positive_up;
    const auto also = formats::gocad_tsurf::write(path_of("faults.ts"), faces.tables, how);
    done.renamed.insert(done.renamed.end(), also.begin(), also.end());
  }
  write_whole_file(path_of("README.txt"),
                   note(project, faces, options, !sticks.sticks.empty(), !faces.tables.empty()));

  // 4. A name that two formats had to change the same way is told once.
  std::sort(done.renamed.begin(), done.renamed.end());
  done.renamed.erase(std::unique(done.renamed.begin(), done.renamed.end()), done.renamed.end());
  return done;
}

}  // namespace footwall::tasks
