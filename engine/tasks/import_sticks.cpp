#include "engine/tasks/import_sticks.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <set>

#include "storage/base/error.h"
#include "storage/formats/names.h"
#include "storage/formats/stick_formats.h"
#include "storage/project/fault_colours.h"

namespace footwall::tasks {
namespace {

std::string free_name(const std::string& wanted, const std::set<std::string>& taken) {
  std::string name = wanted;
  for (int n = 2; taken.contains(name); ++n) {
    const std::string suffix = fmt::format(" ({})", n);
    name = formats::clean_name(wanted, formats::kLongestName - suffix.size()) + suffix;
  }
  return name;
}

std::int64_t points_outside(const survey::Geometry& survey, const std::vector<formats::Stick>& sticks) {
  std::int64_t outside = 0;
  for (const formats::Stick& stick : sticks) {
    for (const survey::WorldPoint& point : stick.points) {
      const survey::IndexPoint p = survey.index_of(point);
      const auto beyond = [](double at, std::int64_t n) {
        return !(at >= -0.5 && at <= static_cast<double>(n) - 0.5);
      };
      outside += beyond(p.i, survey.inlines.count) || beyond(p.j, survey.crosslines.count) ||
                 beyond(p.k, survey.samples);
    }
  }
  return outside;
}

struct Read {
  std::vector<formats::Stick> sticks;
  SticksImported counts;
  std::map<std::string, std::string> names;  // in the file -> in the project
};

Read read(const project::Project& project, const std::filesystem::path& file, const std::string& format,
          formats::SticksOptions options) {
  options.survey = project.survey();
  options.vertical_unit = options.survey ? std::string(name_of(options.survey->vertical_unit)) : "";
  formats::SticksImport from_file = formats::read_sticks(file, format, options);
  if (std::any_of(from_file.sticks.begin(), from_file.sticks.end(),
                  [](const formats::Stick& stick) { return stick.in_line_numbers; })) {
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("{}: the sticks are in inline and crossline numbers, and the project has no survey",
                    file.string()),
        "import a volume of the survey first (footwall import volume), or use columns of X and Y");
  }
  Read read{std::move(from_file.sticks), {}, {}};
  SticksImported& counts = read.counts;
  counts.report = std::move(from_file.report);
  counts.format = std::move(from_file.format);
  counts.notices = std::move(from_file.notices);
  counts.pillars = static_cast<std::int64_t>(read.sticks.size());
  if (options.survey) {
    if (const std::int64_t outside = points_outside(*options.survey, read.sticks); outside > 0) {
      counts.notices.push_back(
          fmt::format("{} of {} points lie outside the survey: check coordinates, unit and sign of z",
                      outside, counts.report.read));
    }
  }
  std::set<std::string> taken;
  for (const project::FaultRecord& fault : project.faults()) taken.insert(fault.name);
  for (const formats::Stick& stick : read.sticks) {
    if (read.names.contains(stick.fault)) continue;
    const std::string name = free_name(stick.fault, taken);
    if (name != stick.fault) counts.report.renamed.push_back(stick.fault + " -> " + name);
    read.names[stick.fault] = name;
    taken.insert(name);
    counts.faults.push_back(name);
  }
  return read;
}

}  // namespace

SticksImported import_sticks(project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const formats::SticksOptions& options,
                             const JobContext& job) {
  const Read from_file = read(project, file, format, options);
  job.report(0.5, "read");
  const std::vector<project::FaultRecord> known = project.faults();
  project.edit(formats::clean_name("Import " + file.filename().string()),
               [&](project::Interpretation& picks) {
                 std::map<std::string, std::int64_t> ids;
                 project::FaultColours colours(known);
                 const std::size_t total = from_file.sticks.size();
                 std::size_t stored = 0;
                 for (const formats::Stick& stick : from_file.sticks) {
                   if (++stored % 256 == 0) {
                     job.report(0.5 + 0.5 * static_cast<double>(stored) / static_cast<double>(total), "store",
                                fmt::format("{} of {} sticks", stored, total));
                   }
                   job.check();
                   const auto [id, is_new] = ids.try_emplace(stick.fault, 0);
                   if (is_new) {
                     id->second = picks.add_fault(from_file.names.at(stick.fault));
                     picks.set_fault_property(id->second, "colour", colours.next());
                   }
                   picks.add_pillar(id->second, survey::PillarKind::kInterpreted, stick.points);
                 }
               });
  return from_file.counts;
}

SticksPreview preview_sticks(const project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const formats::SticksOptions& options) {
  const Read from_file = read(project, file, format, options);
  SticksPreview preview{from_file.counts, {}};
  for (const formats::Stick& stick : from_file.sticks) {
    for (const survey::WorldPoint& point : stick.points) {
      if (preview.rows.size() == SticksPreview::kRows) return preview;
      preview.rows.push_back({from_file.names.at(stick.fault), stick.number, point});
    }
  }
  return preview;
}

}  // namespace footwall::tasks
