// footwall views: the saved cameras.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, remove;
};

console::Output run(const Options& options) {
  if (!options.remove.empty()) {
    project::Project project = open_project(options.project, project::OpenMode::kWrite);
    project.delete_view(options.remove);
    project.close();
    return {{{"deleted", options.remove}}, fmt::format("deleted view {}", options.remove)};
  }
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  console::Output output{{{"views", console::Json::array()}}, ""};
  for (const project::ViewRecord& view : project.views()) {
    const bool chosen = view.exaggeration == 0;
    output.json["views"].push_back(
        {{"name", view.name},
         {"camera", view.camera},
         {"exaggeration", chosen ? console::Json() : console::Json(view.exaggeration)},
         {"when", view.when}});
    output.text +=
        fmt::format("{}: {}{}, {}\n", view.name, view.camera,
                    chosen ? std::string() : fmt::format(", z x {}", view.exaggeration), view.when);
  }
  if (output.text.empty()) output.text = "no saved views; footwall render --save-view saves one\n";
  return output;
}

}  // namespace

void add_views(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "views", "List the saved views, or delete one",
                                  [options](console::Console&) { return run(*options); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--delete", options->remove, "Delete the view of this name");
}

}  // namespace footwall::commands
