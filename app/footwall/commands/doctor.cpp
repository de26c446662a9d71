// footwall doctor: is this machine, or a folder, fit for work?
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "engine/tasks/doctor/doctor.h"

namespace footwall::commands {
namespace {

struct Options {
  std::optional<std::string> path;
};

const char* word_for(tasks::Verdict verdict) {
  switch (verdict) {
    case tasks::Verdict::kOk:
      return "ok";
    case tasks::Verdict::kWarning:
      return "warning";
    case tasks::Verdict::kFailed:
      break;
  }
  return "failed";
}

console::Output output_of(const std::vector<tasks::Finding>& findings) {
  console::Output output;
  output.json["checks"] = console::Json::array();
  std::size_t width = 0;
  for (const tasks::Finding& finding : findings) width = std::max(width, finding.name.size());
  for (const tasks::Finding& finding : findings) {
    const char* word = word_for(finding.verdict);
    output.json["checks"].push_back(
        {{"name", finding.name}, {"status", word}, {"what", finding.what}, {"hint", finding.hint}});
    output.text += fmt::format("{:<{}}  {:<7}  {}{}\n", finding.name, width, word, finding.what,
                               finding.hint.empty() ? "" : " - " + finding.hint);
    if (finding.verdict == tasks::Verdict::kFailed) output.status = 1;
  }
  return output;
}

console::Output run(const Options& options, const console::Console& console) {
  return output_of(options.path ? tasks::check_folder(*options.path, {}, console.job())
                                : tasks::check_machine(".", {}, console.job()));
}

}  // namespace

void add_doctor(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "doctor", "Tell whether this machine, or a folder, is fit for work",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("--path", options->path,
                      "Look at this folder instead: locks, flushing, parallel files, speed");
}

}  // namespace footwall::commands
