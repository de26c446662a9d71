// footwall compare: one statistic of a fault in two runs, on the fault's chart raster.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/compare_runs.h"
#include "engine/tasks/triangulate.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, csv;
  std::vector<std::int64_t> runs;
  tasks::CompareChoice choice;
};

console::Json or_null(const std::optional<double>& value) {
  return value ? console::Json(*value) : console::Json();
}

std::string in_words(const std::optional<double>& value) {
  return value ? fmt::format("{:.5g}", *value) : "-";
}

console::Output run(const Options& options, const JobContext& job) {
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  tasks::CompareChoice choice = options.choice;
  choice.run_a = options.runs[0];
  choice.run_b = options.runs[1];
  const tasks::RunComparison made = tasks::compare_runs(project, choice, job);
  const double across = made.raster.cell * made.metres.strike, down = made.raster.cell * made.metres.dip;
  console::Output output;
  output.json = {{"fault", made.fault},
                 {"statistic", made.statistic},
                 {"unit", made.unit},
                 {"runs", {made.run_a.id, made.run_b.id}},
                 {"columns", made.raster.columns},
                 {"rows", made.raster.rows},
                 {"cell_along_m", across},
                 {"cell_down_m", down},
                 {"velocity", made.velocity > 0 ? console::Json(made.velocity) : console::Json()},
                 {"velocity_assumed", made.assumed_velocity},
                 {"both", made.both},
                 {"only_a", made.only_a},
                 {"only_b", made.only_b},
                 {"mean", or_null(made.mean)},
                 {"rms", or_null(made.rms)},
                 {"largest", or_null(made.largest)}};
  output.text = fmt::format(
      "{} of {}, run {} minus run {}, on {} x {} cells of {:.4g} x {:.4g} m{}\n"
      "{} cells in both, {} in run {} alone, {} in run {} alone\n"
      "difference: mean {}, root mean square {}, largest {}{}\n",
      made.statistic, made.fault, made.run_b.id, made.run_a.id, made.raster.columns, made.raster.rows, across,
      down, made.assumed_velocity ? " (no velocity: 1 ms counts 1 m)" : "", made.both, made.only_a,
      made.run_a.id, made.only_b, made.run_b.id, in_words(made.mean), in_words(made.rms),
      in_words(made.largest), made.unit.empty() ? "" : " " + made.unit);
  if (!options.csv.empty()) {
    tasks::write_csv(made, tasks::required_survey(project, "the comparison of runs"), options.csv);
    output.json["csv"] = options.csv;
    output.text += "written to " + options.csv + "\n";
  }
  return output;
}

}  // namespace

void add_compare(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "compare", "One statistic of a fault in two runs, also on different meshes",
                  [options](console::Console& console) { return run(*options, console.job()); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--fault", options->choice.fault, "The fault")->required();
  command->add_option("--runs", options->runs, "The numbers of the two runs, A,B: the difference is B - A")
      ->delimiter(',')
      ->expected(2)
      ->required();
  command->add_option("--statistic", options->choice.statistic, "What is compared (default variance)");
  command->add_option("--cell", options->choice.cell, "Size of a cell on the fault, in voxels (default 1)")
      ->check(CLI::PositiveNumber);
  command->add_option("--csv", options->csv, "Write the cells to this file");
}

}  // namespace footwall::commands
