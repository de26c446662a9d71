// footwall undo, redo, history: the edit log.
#include <fmt/format.h>
#include <ctime>
#include <memory>
#include <optional>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project;
  std::optional<int> trim_days;
};

std::string days_ago(int days) {
  const std::time_t then = std::time(nullptr) - std::time_t{86400} * days;
  std::tm parts{};
  gmtime_r(&then, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

console::Output trim(const Options& options) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const project::HistorySize dropped = project.trim_history(days_ago(*options.trim_days));
  const project::HistorySize left = project.history_size();
  project.close();
  return {{{"dropped", dropped.steps}, {"dropped_bytes", dropped.bytes}, {"steps_left", left.steps}},
          fmt::format("{} steps of {:.1f} MiB dropped, {} left", dropped.steps,
                      static_cast<double>(dropped.bytes) / (1 << 20), left.steps)};
}

console::Output step(const Options& options, bool back) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const std::optional<std::string> name = back ? project.undo() : project.redo();
  project.close();
  if (!name) {
    throw Error(ErrorCode::kInvalid, back ? "there is nothing to undo" : "there is nothing to redo",
                "footwall history lists the steps");
  }
  return {{{back ? "undone" : "redone", *name}}, (back ? "undone: " : "redone: ") + *name};
}

console::Output list(const Options& options) {
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  console::Output output{{{"steps", console::Json::array()}}, ""};
  for (const project::HistoryStep& one : project.history()) {
    output.json["steps"].push_back({{"step", one.id},
                                    {"name", one.name},
                                    {"when", one.when},
                                    {"undone", one.undone},
                                    {"barrier", one.barrier}});
    output.text += fmt::format("{:>5}  {}  {}{}\n", one.id, one.when, one.name,
                               one.barrier  ? "  (history ends here)"
                               : one.undone ? "  (undone)"
                                            : "");
  }
  if (output.text.empty()) output.text = "no edits yet\n";
  return output;
}

}  // namespace

void add_history(console::Program& program) {
  auto options = std::make_shared<Options>();
  const auto add = [&](const char* name, const char* help, const console::Program::Run& run) {
    CLI::App* command = program.add(nullptr, name, help, run);
    command->add_option("project", options->project, "The project, NAME.footwall")->required();
    return command;
  };
  add("undo", "Take the last edit back", [options](console::Console&) { return step(*options, true); });
  add("redo", "Bring the last undone edit back",
      [options](console::Console&) { return step(*options, false); });
  add("history", "List the edits",
      [options](console::Console&) { return options->trim_days ? trim(*options) : list(*options); })
      ->add_option("--trim-before", options->trim_days,
                   "Drop the steps that are older than so many days: what they did can no longer be undone")
      ->check(CLI::Range(0, 36500));
}

}  // namespace footwall::commands
