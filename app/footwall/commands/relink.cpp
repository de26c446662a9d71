// footwall relink: a volume's file has moved.
#include <fmt/format.h>
#include <memory>

#include "engine/tasks/relink.h"

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, file, volume;
};

}  // namespace

void add_relink(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(
      nullptr, "relink", "Tell a project where a volume's file is now", [options](console::Console&) {
        project::Project project = open_project(options->project, project::OpenMode::kWrite);
        const std::string volume = tasks::relink_volume(project, options->volume, options->file);
        project.close();
        return console::Output{{{"volume", volume}, {"file", options->file}},
                               fmt::format("volume {} is read from {} now", volume, options->file)};
      });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("file", options->file, "Where the volume's file is")->required();
  command->add_option("--volume", options->volume,
                      "The volume (default: the one that has the file's checksum)");
}

}  // namespace footwall::commands
