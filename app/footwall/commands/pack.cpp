// footwall pack: a project and its volumes as one archive, and back.
#include <fmt/format.h>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/pack.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string source, archive;
  bool unpack = false;
  std::optional<std::string> into;
  bool without_missing = false;
};

std::string left_out(const std::vector<std::string>& missing) {
  return missing.empty() ? "" : fmt::format("; without {}", fmt::join(missing, ", "));
}

console::Output unpack(const Options& options, const console::Console& console) {
  if (!options.archive.empty() || options.without_missing) {
    throw Error(ErrorCode::kUsage, "--unpack takes the archive alone",
                "--into names the folder to unpack in");
  }
  const tasks::Unpacked done =
      tasks::unpack_project(options.source, options.into.value_or("."), console.job());
  return {{{"project", done.project.string()}, {"volumes", done.volumes}, {"missing", done.missing}},
          fmt::format("{} with {} volumes, every checksum agrees{}", done.project.string(),
                      done.volumes.size(), left_out(done.missing))};
}

console::Output run(const Options& options, const console::Console& console) {
  if (options.unpack) return unpack(options, console);
  if (options.into) throw Error(ErrorCode::kUsage, "--into belongs to --unpack");
  if (options.archive.empty()) {
    throw Error(ErrorCode::kUsage, "the archive's name is missing",
                fmt::format("footwall pack {0} {0}.tar", options.source));
  }
  const project::Project project = open_project(options.source, project::OpenMode::kRead);
  const tasks::Packed done =
      tasks::pack_project(project, options.archive, {options.without_missing}, console.job());
  return {
      {{"archive", done.archive.string()},
       {"bytes", done.bytes},
       {"volumes", done.volumes},
       {"missing", done.missing}},
      fmt::format("{}: the project and {} volumes, {:.1f} MiB{}", done.archive.string(), done.volumes.size(),
                  static_cast<double>(done.bytes) / 1048576.0, left_out(done.missing))};
}

}  // namespace

void add_pack(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "pack", "Make one archive of a project and its volumes, or unpack one",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("source", options->source, "The project, NAME.footwall; with --unpack the archive")
      ->required();
  command->add_option("archive", options->archive, "The archive to make, usually NAME.footwall.tar");
  command->add_flag("--unpack", options->unpack, "Unpack an archive and check every byte of it");
  command->add_option("--into", options->into, "The folder to unpack in (default: the present one)");
  command->add_flag("--without-missing", options->without_missing,
                    "Pack although volumes are missing, without them");
}

}  // namespace footwall::commands
