// footwall undo, redo, history: the edit log.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project;
};

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
    program.add(nullptr, name, help, run)
        ->add_option("project", options->project, "The project, NAME.footwall")
        ->required();
  };
  add("undo", "Take the last edit back", [options](console::Console&) { return step(*options, true); });
  add("redo", "Bring the last undone edit back",
      [options](console::Console&) { return step(*options, false); });
  add("history", "List the edits", [options](console::Console&) { return list(*options); });
}

}  // namespace footwall::commands
