// footwall serve: keeps an engine running in the foreground.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "engine/tasks/serve.h"
#include "storage/base/log.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, listen = "unix", volumes, memory, connection;
  EngineOptions engine;
};

// "4GiB", "512 MiB"; a number alone is MiB.
std::int64_t bytes_from(const std::string& text) {
  struct Unit {
    std::string_view name;
    double bytes;
  };
  constexpr std::array kUnits{Unit{"", 0x1p20}, Unit{"MiB", 0x1p20}, Unit{"GiB", 0x1p30}, Unit{"TiB", 0x1p40},
                              Unit{"MB", 1e6},  Unit{"GB", 1e9},     Unit{"TB", 1e12}};
  const std::size_t digits = text.find_first_not_of("0123456789.");
  const auto number = text::number(text.substr(0, digits));
  const std::string_view name =
      digits == std::string::npos ? "" : text::trimmed(std::string_view(text).substr(digits));
  for (const Unit& unit : kUnits) {
    if (number && name == unit.name && *number * unit.bytes >= 1 && *number * unit.bytes < 0x1p60)
      return static_cast<std::int64_t>(*number * unit.bytes);
  }
  throw Error(ErrorCode::kUsage, fmt::format("--memory '{}' is no amount of memory", text),
              "write a number of MiB, or one with its unit, such as 4GiB");
}

void check(const Options& options) {
  const std::string& listen = options.listen;
  const bool good = listen == "unix" || listen.starts_with("unix:/") || listen.starts_with("tcp:");
  if (!good) {
    throw Error(ErrorCode::kUsage, fmt::format("--listen '{}' is no address", listen),
                "give unix, unix:/PATH, or tcp:HOST:PORT (port 0: any that is free)");
  }
  if (!options.volumes.empty() && !std::filesystem::is_directory(options.volumes)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no folder {}", options.volumes),
                "name the folder that has the volumes");
  }
}

// At once, since the command goes on for as long as the engine runs.
void say(const std::string& text, bool json) {
  if (json) {
    log::info(text);
    return;
  }
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);
}

std::string in_words(const service::Connection& connection, const std::filesystem::path& file,
                     const tasks::Replayed& replayed, bool with_project) {
  std::string text = fmt::format("serving at {}", connection.address);
  if (!connection.fingerprint.empty()) text += fmt::format("\nfingerprint {}", connection.fingerprint);
  if (with_project)
    text += fmt::format("\nholds {} volume{}, {} faces", replayed.volumes.size(),
                        replayed.volumes.size() == 1 ? "" : "s", replayed.faces);
  return text + fmt::format("\nuse it with --engine @{}", file.string());
}

console::Output run(const Options& options, bool json, console::Console& console) {
  check(options);
  tasks::ServeOptions how;
  how.project = options.project;
  how.connection = options.connection;
  how.engine.launch = options.engine.launch();
  how.engine.listen = options.listen;
  how.engine.volumes = options.volumes;
  if (!options.memory.empty()) how.engine.memory_bytes = bytes_from(options.memory);
  tasks::ServeEvents events;
  events.ready = [&](const service::Connection& connection, const std::filesystem::path& file,
                     const tasks::Replayed& replayed) {
    console.end_progress();
    for (const std::string& notice : replayed.notices) log::warn(notice);
    say(in_words(connection, file, replayed, !options.project.empty()), json);
  };
  events.died = [&](const std::string& words) {
    console.end_progress();
    log::warn(fmt::format("the engine {}; it is started again", words));
  };
  const tasks::Served served = tasks::serve(how, events, console.job());
  console::Output output;
  output.json = {{"address", served.connection.address},
                 {"fingerprint", served.connection.fingerprint},
                 {"connection", served.file.string()},
                 {"starts", served.starts},
                 {"seconds", served.seconds}};
  output.text = fmt::format("stopped after {:.0f} s", served.seconds);
  return output;
}

}  // namespace

void add_serve(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(
      nullptr, "serve", "Keep an engine running, for as long as this command does",
      [options, &program](console::Console& console) { return run(*options, program.json(), console); });
  command->add_option("project", options->project, "The project whose volumes and faults it holds");
  options->engine.add_to(*command);
  command->add_option("--listen", options->listen,
                      "unix (default: a socket of this user alone), unix:/PATH, or tcp:HOST:PORT with TLS");
  command->add_option("--volumes", options->volumes,
                      "A folder whose volumes are found by their checksums, wherever the project is");
  command->add_option("--memory", options->memory,
                      "The most that the ranks of a machine hold, in MiB or as 4GiB (default: what is free)");
  command->add_option(
      "--connection", options->connection,
      "The file to write, which clients are given as @FILE (default: a place where status and stop look)");
}

}  // namespace footwall::commands
