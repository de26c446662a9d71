// footwall edit: JSON lines from standard input, each one undoable edit, each answered by one line.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/edit_at_holder.h"
#include "engine/tasks/edit_script.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project;
};

// Where an editor holds the project, it makes the edits: at once visible there, each a step of its history.
std::unique_ptr<tasks::EditAtHolder> holder_of(const std::string& path, const Error& held) {
  const std::string socket = project::edit_socket_of(path);
  if (held.code() != ErrorCode::kHeld || socket.empty()) return nullptr;
  try {
    return std::make_unique<tasks::EditAtHolder>(socket);
  } catch (const Error& error) {
    log::warn(error.message());
    return nullptr;
  }
}

// Replies are printed as they come, so that a script which feeds line by line reads them line by line; with
// --json they are gathered into the one object.
console::Output apply(const Options& options, bool json, const JobContext& job) {
  console::Output output{{{"replies", console::Json::array()}}, ""};
  const auto reply = [&](const nlohmann::json& one) {
    output.json["replies"].push_back(console::Json(one));
    if (!json) std::cout << one.dump() << std::endl;
  };
  std::optional<project::Project> project;
  std::unique_ptr<tasks::EditAtHolder> holder;
  try {
    project.emplace(open_project(options.project, project::OpenMode::kWrite));
  } catch (const Error& error) {
    holder = holder_of(options.project, error);
    if (!holder) throw;
  }
  if (holder) {
    tasks::apply_edit_script(
        [&](std::string_view line, std::int64_t number) { return holder->apply(line, number); }, std::cin,
        reply, job);
    return output;
  }
  tasks::apply_edit_script(*project, std::cin, reply, job);
  project->close();
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
