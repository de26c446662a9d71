// Runs with made-up numbers, of the faces as they stand in the project's surfaces.
#pragma once
#include <QTest>
#include <functional>

#include "engine/tasks/statistics.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

// Waits for the surface of every fault.
inline bool has_surfaces(const Workbench& bench) {
  return QTest::qWaitFor(
      [&] {
        return bench.surfaces.is_settled() &&
               std::ranges::all_of(bench.document.faults(), [&](const Fault& fault) {
                 return bench.surfaces.surface(fault.record.id) != nullptr;
               });
      },
      30'000);
}

// The surface's faces but for the last `left_out`, each with the value of its place as variance and contrast.
inline project::FaultRun made_numbers(const FaultSurface& surface,
                                      const std::function<double(std::size_t)>& value,
                                      std::size_t left_out = 0) {
  project::FaultRun of_fault;
  of_fault.fault = surface.fault;
  of_fault.revision = surface.revision;
  for (std::size_t f = 0; f + left_out < surface.faces.size(); ++f) {
    of_fault.panels.push_back(surface.faces[f].panel);
    of_fault.numbers.push_back(surface.faces[f].n);
    of_fault.lattice.push_back(surface.lattice[f]);
    of_fault.statistics["count"].push_back(100);
    of_fault.statistics["dip"].push_back(-1);  // that of the faces now is shown
    for (const char* name : {"variance", "contrast"}) of_fault.statistics[name].push_back(value(f));
  }
  return of_fault;
}

// Of the volume shown and of all faults; tells nobody.
inline Id add_made_run(Workbench& bench, const std::string& name,
                       const std::function<double(std::size_t)>& value, std::size_t left_out = 0) {
  project::Project& project = bench.document.store();
  project.register_statistics(tasks::stored_statistics());
  project::RunRecord run;
  run.name = name;
  run.volume = bench.document.volumes().front().name;
  run.volume_checksum = bench.document.volumes().front().checksum;
  std::vector<project::FaultRun> faults;
  for (const Fault& fault : bench.document.faults()) {
    faults.push_back(made_numbers(*bench.surfaces.surface(fault.record.id), value, left_out));
    faults.back().fault_name = fault.record.name;
  }
  return project.add_run(run, faults);
}

// A run "base" and a newer one, whose numbers are those known now; the order of their faces is the opposite.
struct TwoRuns {
  Id base = 0, newer = 0;
  static double of_base(std::size_t face) { return 2 + static_cast<double>(face); }
  static double of_newer(std::size_t face) { return -3 * static_cast<double>(face) - 1; }
};

// Nothing where the surfaces or the numbers did not come.
inline std::optional<TwoRuns> add_two_runs(Workbench& bench, std::size_t left_out_of_base = 0) {
  if (!has_surfaces(bench)) return {};
  TwoRuns runs;
  runs.base = add_made_run(bench, "base", TwoRuns::of_base, left_out_of_base);
  runs.newer = add_made_run(bench, "newer", TwoRuns::of_newer);
  Q_EMIT bench.document.runs_changed();
  const bool known = QTest::qWaitFor(
      [&] {
        return std::ranges::all_of(bench.document.faults(), [&](const Fault& fault) {
          return bench.surfaces.numbers(fault.record.id, QStringLiteral("variance")) != nullptr;
        });
      },
      30'000);
  return known ? std::optional(runs) : std::nullopt;
}

}  // namespace footwall::ui
