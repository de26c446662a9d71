// footwall edit: JSON lines from standard input, each one undoable edit, each answered by one line.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/edit_script.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project;
};

// Replies are printed as they come, so that a script which feeds line by line reads them line by line; with
// --json they are gathered into the one object.
console::Output apply(const Options& options, bool json, const JobContext& job) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  console::Output output{{{"replies", console::Json::array()}}, ""};
  tasks::apply_edit_script(
      project, std::cin,
      [&](const nlohmann::json& reply) {
        output.json["replies"].push_back(console::Json(reply));
        if (!json) std::cout << reply.dump() << std::endl;
      },
      job);
  project.close();
  return output;
}

// The end that an edit came to is a reply, too.
console::Output run(const Options& options, bool json, const JobContext& job) {
  try {
    return apply(options, json, job);
  } catch (const Error& error) {
    if (!json) std::cout << console::error_json(error).dump() << std::endl;
    throw;
  }
}

}  // namespace

void add_edit(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "edit", "Apply JSON lines from standard input, each one undoable edit",
                  [options, &program](console::Console& console) {
                    return run(*options, program.json(), console.job());
                  });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
}

}  // namespace footwall::commands
