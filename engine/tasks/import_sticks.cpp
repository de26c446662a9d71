#include "engine/tasks/import_sticks.h"

#include <fmt/format.h>
#include <map>
#include <set>

#include "storage/formats/stick_formats.h"

namespace footwall::tasks {
namespace {

std::string free_name(const std::string& wanted, const std::set<std::string>& taken) {
  if (!taken.contains(wanted)) return wanted;
  for (int n = 2;; ++n) {
    std::string name = fmt::format("{} ({})", wanted, n);
    if (!taken.contains(name)) return name;
  }
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

}  // namespace

SticksImported import_sticks(project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const formats::SticksOptions& options) {
  formats::SticksImport read = formats::read_sticks(file, format, options);
  SticksImported imported;
  imported.report = std::move(read.report);
  if (const auto survey = project.survey()) {
    if (const std::int64_t outside = points_outside(*survey, read.sticks); outside > 0) {
      imported.notices.push_back(
          fmt::format("{} of {} points lie outside the survey: check coordinates, unit and sign of z",
                      outside, imported.report.read));
    }
  }
  project.edit("Import " + file.filename().string(), [&](project::Interpretation& picks) {
    std::set<std::string> taken;
    for (const project::FaultRecord& fault : picks.faults()) taken.insert(fault.name);
    std::map<std::string, std::int64_t> ids;
    for (const formats::Stick& stick : read.sticks) {
      if (!ids.contains(stick.fault)) {
        const std::string name = free_name(stick.fault, taken);
        if (name != stick.fault) imported.report.renamed.push_back(stick.fault + " -> " + name);
        ids[stick.fault] = picks.add_fault(name);
        taken.insert(name);
        imported.faults.push_back(name);
      }
      picks.add_pillar(ids[stick.fault], survey::PillarKind::kInterpreted, stick.points);
      ++imported.pillars;
    }
  });
  return imported;
}

}  // namespace footwall::tasks
