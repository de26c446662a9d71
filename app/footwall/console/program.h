// The command line as a whole: commands are added, one is run, its answer printed, its errors caught once.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/footwall/console/console.h"

namespace footwall::console {

class Program {
 public:
  Program(std::string name, std::string description, const std::string& version);

  using Run = std::function<Output(Console&)>;
  // Adds a command with --json and --quiet; `run` is called once the options are parsed. Options bound to
  // variables must outlive the program's run: bind them to a shared_ptr that `run` holds.
  // parent: another command (e.g. "import" of "import volume"), null for the top level.
  CLI::App* add(CLI::App* parent, const std::string& name, const std::string& description, Run run);
  // A command that only groups others.
  CLI::App* add_group(const std::string& name, const std::string& description);

  // Whether --json was given; to be asked while running.
  bool json() const { return json_; }

  // Parses, runs, prints; returns the exit status (docs/commands.md).
  int run(int argc, char** argv);

 private:
  CLI::App app_;
  bool json_ = false;
  bool quiet_ = false;
  Run chosen_;
};

}  // namespace footwall::console
