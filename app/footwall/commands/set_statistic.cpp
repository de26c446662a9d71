// footwall set-statistic: the user's own number for each face.
#include "engine/tasks/set_statistic.h"

#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, values;
  tasks::SetStatistic what;
};

console::Output run(const Options& options) {
  std::ifstream file;
  if (options.values != "-") {
    file.open(options.values, std::ios::binary);
    if (!file) throw io_error("read", options.values, errno);
  }
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::StatisticSet done =
      tasks::set_statistic(project, options.what, options.values == "-" ? std::cin : file);
  project.close();
  console::Output output;
  output.json = {{"run", done.run},           {"name", done.run_name}, {"statistic", options.what.name},
                 {"unit", options.what.unit}, {"faces", done.faces},   {"undefined", done.undefined},
                 {"replaced", done.replaced}};
  output.text = fmt::format("run {}: {} of {} faces, {} without{}\n", done.run, options.what.name, done.faces,
                            done.undefined, done.replaced ? "; in place of the former one" : "");
  return output;
}

}  // namespace

void add_set_statistic(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "set-statistic", "Keep your own number for each face, as a run",
                                  [options](console::Console&) { return run(*options); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("name", options->what.name, "What the number is called")->required();
  command->add_option("--unit", options->what.unit, "Its unit; 1: none")->capture_default_str();
  command->add_option("--values", options->values, "CSV file with columns face and value; -: standard input")
      ->required();
  command->add_option("--run", options->what.run, "Name of the run (default: that of the statistic)");
}

}  // namespace footwall::commands
