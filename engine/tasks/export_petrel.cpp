#include "engine/tasks/export_petrel.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <system_error>

#include "engine/tasks/face_tables.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/points_table.h"
#include "storage/formats/stick_formats.h"
#include "storage/formats/z_unit.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

// Pillars as sticks, numbered from 1 within their fault, z in `unit`.
std::vector<formats::Stick> sticks_of(const project::Project& project, const std::string& fault,
                                      const std::string& unit) {
  const auto survey = project.survey();
  const double factor = survey ? formats::z_unit_factor(name_of(survey->vertical_unit), unit) : 1;
  std::vector<formats::Stick> sticks;
  for (const project::FaultRecord& record : chosen_faults(project, fault)) {
    std::int64_t number = 0;
    for (const survey::Pillar& pillar : project.pillars(record.id)) {
      formats::Stick stick;
      stick.fault = record.name;
      stick.number = ++number;
      for (const survey::PillarNode& node : pillar.nodes)
        stick.points.push_back({node.position.x, node.position.y, node.position.z * factor});
      sticks.push_back(std::move(stick));
    }
  }
  return sticks;
}

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
      project.path().filename().string(), domain_line(survey), faces.units.vertical,
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
  const std::vector<formats::Stick> sticks = sticks_of(project, options.fault, faces.units.vertical);
  if (sticks.empty() && faces.tables.empty()) {
    throw Error(ErrorCode::kInvalid, "there are neither pillars nor faces to export",
                "footwall import sticks, import surface and triangulate make them");
  }
  const formats::StickFormat& charisma = formats::stick_format("charisma");
  if (!sticks.empty() && charisma.write == nullptr)
    throw Error(ErrorCode::kUnsupported, "this program does not write Charisma fault sticks");
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
  if (!sticks.empty()) {
    formats::SticksWriteOptions how;
    how.z_positive_up = options.z_positive_up;
    how.names_without_blanks = true;
    how.horizontal_unit = faces.units.horizontal;
    how.vertical_unit = faces.units.vertical;
    how.survey = project.survey();
    write_whole_file(path_of("fault_sticks.txt"), charisma.write(sticks, how, done.renamed));
  }

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
                   note(project, faces, options, !sticks.empty(), !faces.tables.empty()));

  // 4. A name that two formats had to change the same way is told once.
  std::sort(done.renamed.begin(), done.renamed.end());
  done.renamed.erase(std::unique(done.renamed.begin(), done.renamed.end()), done.renamed.end());
  return done;
}

}  // namespace footwall::tasks
