// footwall bench service: what the user of a running engine waits for.
#include "app/footwall/commands/bench_service.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/footwall/commands/launch_options.h"
#include "engine/tasks/bench_service.h"

namespace footwall::commands {
namespace {

struct Options {
  EngineOptions engine;
  tasks::ServiceBench how;
  double volume = 1024;  // MiB
};

std::string goal_of(const tasks::ServiceFigure& figure) {
  return figure.goal ? fmt::format("< {:g} {}", *figure.goal, figure.unit) : "-";
}

console::Output run(Options& options, const console::Console& console) {
  constexpr double kMiB = 1 << 20;
  constexpr double kMostMiB = 1 << 20;
  if (!(options.volume >= 0 && options.volume <= kMostMiB)) {
    throw Error(ErrorCode::kUsage, fmt::format("--volume {} cannot be", options.volume),
                "give MiB, from 0 (not measured) to 1048576");
  }
  options.how.volume_bytes = static_cast<std::int64_t>(options.volume * kMiB);
  options.how.launch = options.engine.launch();
  const std::vector<tasks::ServiceFigure> figures = tasks::bench_service(options.how, console.job());
  console::Output output;
  output.json = {{"checked", true}, {"figures", console::Json::array()}};
  output.text = fmt::format("{:<64} {:>14} {:>18} {:>4}\n", "", "goal", "figure", "met");
  for (const tasks::ServiceFigure& figure : figures) {
    const bool met = figure.goal && figure.value < *figure.goal;
    output.json["figures"].push_back({{"name", figure.name},
                                      {"what", figure.what},
                                      {"value", figure.value},
                                      {"unit", figure.unit},
                                      {"goal", figure.goal ? console::Json(*figure.goal) : console::Json()},
                                      {"met", figure.goal ? console::Json(met) : console::Json()},
                                      {"more", figure.more}});
    output.text += fmt::format("{:<64} {:>14} {:>18} {:>4}\n  {}\n", figure.what, goal_of(figure),
                               fmt::format("{:.3f} {}", figure.value, figure.unit),
                               !figure.goal ? ""
                               : met        ? "yes"
                                            : "no",
                               figure.more);
  }
  return output;
}

}  // namespace

void add_bench_service(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "service", "What one waits for with a running engine, from call to answer",
                  [options](console::Console& console) { return run(*options, console); });
  options->engine.add_to(*command);
  command->add_option("--faces", options->how.faces, "Of the model (default 10000)");
  command->add_option("--moves", options->how.moves, "Moves of one vertex that are timed (default 10000)");
  command->add_option("--memory-moves", options->how.memory_moves,
                      "Moves after which memory is looked at again (default 100000)");
  command->add_option("--many-faces", options->how.many_faces,
                      "Faces touched by a large batch (default 1000)");
  command->add_option("--batches", options->how.batches, "Large batches (default 100)");
  command->add_option("--rings", options->how.rings, "Commands to sleeping ranks (default 500)");
  command->add_option("--pictures", options->how.pictures,
                      "Pictures of a resident isosurface (default 20; 0: none)");
  command->add_option("--volume", options->volume,
                      "MiB of the volume that is served (default 1024; 0: not measured)");
  command->add_option("--starts", options->how.starts, "Starts of serve (default 3)");
  command->add_option("--idle", options->how.idle_seconds,
                      "Seconds for which ranks are left idle (default 5)");
}

}  // namespace footwall::commands
