// A sample project with as many faults as a test wants, some of their pillars interpolated ones.
#pragma once
#include <string>
#include <vector>

#include "engine/tasks/triangulate.h"
#include "ui/sample_project.h"

namespace footwall::ui {

// Adds `faults` sheets of `pillars` pillars with `nodes` nodes, one behind the other, as one edit.
inline void add_sheets(project::Project& project, int faults, int pillars, int nodes) {
  const survey::Geometry survey = *project.survey();
  const survey::Index dims = survey.dims();
  const auto part = [](int n, int of, double length) { return (n + 0.5) / of * (length - 1); };
  project.edit("sheets", [&](project::Interpretation& now) {
    for (int f = 0; f < faults; ++f) {
      const std::int64_t fault = now.add_fault("sheet " + std::to_string(f));
      for (int p = 0; p < pillars; ++p) {
        std::vector<survey::WorldPoint> places;
        for (int n = 0; n < nodes; ++n) {
          places.push_back(survey.world_of({part(p, pillars, static_cast<double>(dims[0])),
                                            part(f, faults, static_cast<double>(dims[1])) + 0.1 * n,
                                            part(n, nodes, static_cast<double>(dims[2]))}));
        }
        now.add_pillar(fault, survey::PillarKind::kInterpreted, places);
      }
    }
  });
}

// The faults of the sample get pillars between their picked ones.
inline void interpolate_samples(project::Project& project, double every_lines) {
  for (const project::FaultRecord& fault : project.faults()) {
    tasks::interpolate_fault(project, fault, {.every = every_lines, .tolerance = {}}, {});
  }
}

}  // namespace footwall::ui
