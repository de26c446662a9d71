#include "engine/tasks/export_sticks.h"

#include "storage/base/error.h"
#include "storage/formats/stick_formats.h"
#include "storage/formats/z_unit.h"

namespace footwall::tasks {

ProjectSticks project_sticks(const project::Project& project, const SticksChoice& choice) {
  ProjectSticks out;
  out.how.z_positive_up = choice.z_positive_up.value_or(false);
  out.how.names_without_blanks = choice.names_without_blanks;
  out.how.vertical_unit = choice.z_unit;
  out.how.survey = project.survey();
  double factor = 1;
  if (const auto& survey = out.how.survey) {
    const std::string unit(name_of(survey->vertical_unit));
    out.how.horizontal_unit = survey->horizontal_unit;
    if (choice.z_unit.empty()) out.how.vertical_unit = unit;
    factor = formats::z_unit_factor(unit, out.how.vertical_unit);
  } else if (!choice.z_unit.empty()) {
    throw Error(ErrorCode::kUsage,
                "without a survey the unit of z is not known, so that none can be asked for",
                "leave --z-unit out: z is written as it was imported");
  }
  std::vector<project::FaultRecord> faults = project.faults();
  if (!choice.fault.empty()) faults = {project.fault(choice.fault)};
  for (const project::FaultRecord& fault : faults) {
    std::int64_t number = 0;
    for (const survey::Pillar& pillar : project.pillars(fault.id)) {
      if (pillar.kind == survey::PillarKind::kInterpolated && !choice.interpolated) continue;
      formats::Stick stick{fault.name, ++number, {}};
      for (const survey::PillarNode& node : pillar.nodes) {
        stick.points.push_back({node.position.x, node.position.y, node.position.z * factor});
      }
      out.sticks.push_back(std::move(stick));
    }
  }
  return out;
}

SticksExported export_sticks(const project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const SticksChoice& choice) {
  const ProjectSticks chosen = project_sticks(project, choice);
  if (chosen.sticks.empty()) {
    throw Error(ErrorCode::kInvalid, "there are no pillars to export",
                choice.interpolated
                    ? "pick some, or import fault sticks"
                    : "picked and snapped pillars are exported; --interpolated adds the others");
  }
  SticksExported done;
  done.renamed = formats::write_sticks(file, format, chosen.sticks, chosen.how);
  const std::string* last = nullptr;
  for (const formats::Stick& stick : chosen.sticks) {
    done.faults += last == nullptr || *last != stick.fault;
    last = &stick.fault;
    ++done.pillars;
    done.nodes += static_cast<std::int64_t>(stick.points.size());
  }
  return done;
}

}  // namespace footwall::tasks
