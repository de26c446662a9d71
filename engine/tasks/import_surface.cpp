#include "engine/tasks/import_surface.h"

#include <fmt/format.h>
#include <map>
#include <set>

#include "engine/tasks/imported_surface.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/z_unit.h"
#include "storage/project/fault_colours.h"

namespace footwall::tasks {
namespace {

constexpr const char* kKind = "gocad_tsurf";
constexpr std::size_t kLongestName = 200;  // bytes, as project::check_name has it

// A name that the project takes: no blanks at its ends, no control characters, not too long.
std::string usable_name(std::string name, const std::string& otherwise) {
  for (char& letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7f) letter = ' ';
  }
  if (name.size() > kLongestName - 10) {  // room for " (12)"
    name.resize(kLongestName - 10);
    while (!name.empty() && (static_cast<unsigned char>(name.back()) & 0xC0) == 0x80) name.pop_back();
    if (!name.empty() && (static_cast<unsigned char>(name.back()) & 0x80) != 0) name.pop_back();
  }
  const auto first = name.find_first_not_of(' ');
  if (first == std::string::npos) return otherwise;
  return name.substr(first, name.find_last_not_of(' ') - first + 1);
}

// next: the number to try for each name, so that thousands of equal names do not try them all again.
std::string free_name(const std::string& wanted, const std::set<std::string>& taken,
                      std::map<std::string, int>& next) {
  if (!taken.contains(wanted)) return wanted;
  for (int& n = next.try_emplace(wanted, 2).first->second;; ++n) {
    std::string name = fmt::format("{} ({})", wanted, n);
    if (!taken.contains(name)) return name;
  }
}

// What the file's numbers are in; what it does not say is that of the survey, or metres, and is told.
project::SurfaceUnits units_of(const formats::gocad_tsurf::Object& object, const std::string& z_unit,
                               const std::optional<survey::Geometry>& survey, formats::ImportReport& report) {
  const std::string& name = object.surface.name;
  project::SurfaceUnits units{object.horizontal_unit, z_unit.empty() ? object.vertical_unit : z_unit};
  if (units.horizontal != "m" && units.horizontal != "ft") {
    units.horizontal = survey ? survey->horizontal_unit : "m";
    report.assumed.push_back(
        fmt::format("X and Y of {} are in {}: its AXIS_UNIT does not say so", name, units.horizontal));
  }
  if (units.vertical.empty()) {
    units.vertical = survey ? name_of(survey->vertical_unit) : "m";
    report.assumed.push_back(
        fmt::format("z of {} is in {}: its AXIS_UNIT does not say so", name, units.vertical));
  }
  return units;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// Into the survey's units; returns what was done in words, empty where they are the same.
std::string convert(survey::Surface& surface, project::SurfaceUnits& units, const survey::Geometry& survey) {
  const project::SurfaceUnits wanted{survey.horizontal_unit, std::string(name_of(survey.vertical_unit))};
  double across = 1, down = 1;
  try {
    across = formats::z_unit_factor(units.horizontal, wanted.horizontal);
    down = formats::z_unit_factor(units.vertical, wanted.vertical);
  } catch (const Error& error) {
    throw Error(ErrorCode::kInvalid, fmt::format("surface {}: {}", surface.name, error.message()),
                "a file that declares a wrong unit is overridden by --z-unit; " + error.hint());
  }
  if (units == wanted) return {};
  for (survey::WorldPoint& p : surface.vertices) p = {p.x * across, p.y * across, p.z * down};
  std::vector<std::string> steps;
  if (across != 1) steps.push_back(fmt::format("X and Y from {} to {}", units.horizontal, wanted.horizontal));
  if (down != 1) steps.push_back(fmt::format("z from {} to {}", units.vertical, wanted.vertical));
  std::string told = fmt::format("{} was converted: {}", surface.name, listed(steps));
  units = wanted;
  return told;
}

std::string outside_note(const survey::Surface& surface, const survey::Geometry& survey) {
  std::size_t outside = 0;
  for (const survey::WorldPoint& vertex : surface.vertices) {
    const survey::IndexPoint p = survey.index_of(vertex);
    const auto beyond = [](double at, std::int64_t n) {
      return !(at >= -0.5 && at <= static_cast<double>(n) - 0.5);
    };
    outside += beyond(p.i, survey.inlines.count) || beyond(p.j, survey.crosslines.count) ||
               beyond(p.k, survey.samples);
  }
  if (outside == 0) return {};
  return fmt::format("{} of {} vertices of {} lie outside the survey: check coordinates, unit and sign of z",
                     outside, surface.vertices.size(), surface.name);
}

}  // namespace

SurfacesImported import_surface(project::Project& project, const std::filesystem::path& file,
                                const SurfaceImportOptions& options, const JobContext& job) {
  // 1. Read, and bring to the survey's units.
  auto read = formats::gocad_tsurf::read(file, options.z_positive_up);
  SurfacesImported imported;
  imported.report = std::move(read.report);
  const std::optional<survey::Geometry> survey = project.survey();
  std::set<std::string> taken;
  for (const project::FaultRecord& fault : project.faults()) taken.insert(fault.name);
  for (const project::SurfaceRecord& surface : project.surfaces()) taken.insert(surface.name);
  std::map<std::string, int> next;
  std::vector<project::SurfaceUnits> units;
  for (formats::gocad_tsurf::Object& object : read.objects) {
    survey::Surface& surface = object.surface;
    const std::string stated = surface.name;
    const std::string wanted = options.name.empty() ? surface.name : options.name;
    surface.name = free_name(usable_name(wanted, usable_name(file.stem().string(), "surface")), taken, next);
    taken.insert(surface.name);
    if (surface.name != wanted)
      imported.report.renamed.push_back(fmt::format("{} -> {}", wanted, surface.name));
    units.push_back(units_of(object, options.z_unit, survey, imported.report));
    if (!object.properties.empty()) {
      imported.notices.push_back(
          fmt::format("{}: the values of {} properties at the vertices ({}) are not kept", surface.name,
                      object.properties.size(), listed(object.properties)));
    }
    if (!survey) continue;
    if (std::string told = convert(surface, units.back(), *survey); !told.empty())
      imported.notices.push_back(std::move(told));
    if (std::string told = outside_note(surface, *survey); !told.empty())
      imported.notices.push_back(std::move(told));
  }
  job.report(0.5, "read");
  job.check();

  // 2. One edit for all of them.
  project::FaultColours colours(project.faults());
  project.edit(
      "Import " + usable_name(file.filename().string(), "surfaces"), [&](project::Interpretation& picks) {
        for (std::size_t n = 0; n < read.objects.size(); ++n) {
          const survey::Surface& surface = read.objects[n].surface;
          const std::int64_t fault = picks.add_fault(surface.name);
          picks.set_fault_property(fault, "colour", colours.next());
          picks.add_surface(surface, kKind, fault, units[n]);
          imported.faults.push_back({surface.name, static_cast<std::int64_t>(surface.vertices.size()),
                                     static_cast<std::int64_t>(surface.triangles.size())});
        }
      });

  // 3. Their meshes.
  for (const ImportedSurface& made : imported.faults) {
    const Triangulated done = triangulate_fault(project, project.fault(made.fault), {}, job);
    imported.notices.insert(imported.notices.end(), done.notes.begin(), done.notes.end());
  }
  job.report(1, "stored");
  return imported;
}

}  // namespace footwall::tasks
