#include "app/footwall/console/program.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>

#include "storage/base/log.h"

namespace footwall::console {
namespace {

void print(const std::string& text) {
  if (text.empty()) return;
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (text.back() != '\n') std::fputc('\n', stdout);
  if (std::fflush(stdout) != 0) throw io_error("write", "standard output", errno);
}

// Text from files may not be UTF-8; a replacement character is better than no answer.
std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

int fail(const Error& error, bool json) {
  if (json) print(dumped(error_json(error)));
  std::fprintf(stderr, "footwall: %s\n", error.what());
  return exit_status(error.code());
}

bool asks_for_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--json") return true;
  }
  return false;
}

// What CLI11 leaves out when it finds no command: the word that is none. Empty where the words are commands.
std::string unknown_command(const CLI::App& program, int argc, char** argv) {
  const CLI::App* at = &program;
  for (int i = 1; i < argc && at->get_require_subcommand_min() > 0; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("-")) continue;
    try {
      at = at->get_subcommand(word);
    } catch (const CLI::OptionNotFound&) {
      return fmt::format("there is no command '{}{}'", at == &program ? "" : at->get_name() + " ", word);
    }
  }
  return at->get_require_subcommand_min() > 0 ? "a command is missing" : "";
}

}  // namespace

Program::Program(std::string name, std::string description, const std::string& version)
    : app_(std::move(description), std::move(name)) {
  app_.require_subcommand(1);
  app_.set_version_flag("--version", version);
  app_.get_formatter()->column_width(34);
}

CLI::App* Program::add(CLI::App* parent, const std::string& name, const std::string& description, Run run) {
  CLI::App* command = (parent != nullptr ? parent : &app_)->add_subcommand(name, description);
  command->add_flag("--json", json_, "Print exactly one JSON object on standard output");
  command->add_flag("--quiet", quiet_, "Show no progress and no notices");
  command->callback([this, run = std::move(run)] { chosen_ = run; });
  return command;
}

CLI::App* Program::add_group(const std::string& name, const std::string& description) {
  CLI::App* group = app_.add_subcommand(name, description);
  group->require_subcommand(1);
  return group;
}

int Program::run(int argc, char** argv) {
  try {
    app_.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app_.exit(help);
  } catch (const CLI::ParseError& wrong) {
    const std::string unknown = unknown_command(app_, argc, argv);
    return fail(unknown.empty() ? Error(ErrorCode::kUsage, wrong.what(), "--help shows the options")
                                : Error(ErrorCode::kUsage, unknown, "--help shows the commands"),
                asks_for_json(argc, argv));
  }
  log::set_quiet(quiet_);
  try {
    Output output;
    {
      Console console(quiet_);
      output = chosen_(console);
    }
    print(json_ ? dumped(output.json) : output.text);
    return output.status;
  } catch (const Error& error) {
    return fail(error, json_);
  } catch (const std::filesystem::filesystem_error& error) {
    // A path that no file can have: empty, or longer than the system takes.
    const std::string path = error.path1().empty() ? "a file without a name" : error.path1().string();
    return fail(io_error("use", path, error.code().value()), json_);
  } catch (const std::bad_alloc&) {
    return fail(
        Error(ErrorCode::kMemory, "not enough memory", "close other programs or use a smaller survey"),
        json_);
  } catch (const std::exception& error) {
    return fail(Error(ErrorCode::kInternal, error.what(), "this is a bug of Footwall: please report it"),
                json_);
  }
}

}  // namespace footwall::console
