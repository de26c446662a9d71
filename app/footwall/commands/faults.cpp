// footwall faults: faults, pillars and nodes.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/project_facts.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, fault;
};

std::string text_of(const console::Json& list) {
  std::string text;
  for (const console::Json& fault : list["faults"]) {
    const console::Json& surface = fault["surface"];
    const std::string shape = surface.is_null() ? fmt::format("{} pillars", fault["pillars"].size())
                                                : fmt::format("surface, {} vertices, {} triangles",
                                                              surface["vertices"].get<std::int64_t>(),
                                                              surface["triangles"].get<std::int64_t>());
    text += fmt::format("fault {} {} ({}, {}{})\n", fault["fault"].get<std::int64_t>(),
                        fault["name"].get<std::string>(), shape, fault["status"].get<std::string>(),
                        fault["locked"].get<bool>() ? ", locked" : "");
    for (const console::Json& pillar : fault["pillars"]) {
      text += fmt::format("  pillar {} {}\n", pillar["pillar"].get<std::int64_t>(),
                          pillar["kind"].get<std::string>());
      for (const console::Json& node : pillar["nodes"]) {
        text += fmt::format("    node {:<6} X {:.2f}  Y {:.2f}  z {:.2f}", node["node"].get<std::int64_t>(),
                            node["x"].get<double>(), node["y"].get<double>(), node["z"].get<double>());
        if (node.contains("inline")) {
          text += fmt::format("  inline {:.2f}  crossline {:.2f}", node["inline"].get<double>(),
                              node["crossline"].get<double>());
        }
        text += "\n";
      }
    }
  }
  return text.empty() ? "no faults\n" : text;
}

}  // namespace

void add_faults(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "faults", "List faults, their pillars and nodes", [options](console::Console&) {
        const project::Project project = open_project(options->project, project::OpenMode::kRead);
        console::Output output;
        output.json = tasks::fault_list(project, options->fault);
        output.text = text_of(output.json);
        return output;
      });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--fault", options->fault, "Only this fault");
}

}  // namespace footwall::commands
