#include "engine/session/self_check.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/session/child.h"
#include "engine/session/launcher.h"
#include "engine/session/private_folder.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

constexpr const char* kMark = "{\"engine\":";
constexpr auto kPatience = std::chrono::seconds(60);

}  // namespace

std::string to_json(const EngineFacts& facts) {
  Json json{{"ranks", facts.ranks},
            {"mpi_library", facts.mpi_library},
            {"mpi_compiled", facts.mpi_compiled},
            {"mpi_standard", facts.mpi_standard},
            {"hdf5_compiled", facts.hdf5_compiled},
            {"hdf5_running", facts.hdf5_running},
            {"hdf5_trouble", facts.hdf5_trouble}};
  if (facts.rates) json["rates"] = extract::to_text(*facts.rates);
  return kMark + json.dump(-1, ' ', false, Json::error_handler_t::replace) + "}";
}

EngineFacts engine_facts_from(const std::string& text) {
  try {
    const Json json = Json::parse(text).at("engine");
    EngineFacts facts;
    json.at("ranks").get_to(facts.ranks);
    json.at("mpi_library").get_to(facts.mpi_library);
    json.at("mpi_compiled").get_to(facts.mpi_compiled);
    json.at("mpi_standard").get_to(facts.mpi_standard);
    json.at("hdf5_compiled").get_to(facts.hdf5_compiled);
    json.at("hdf5_running").get_to(facts.hdf5_running);
    json.at("hdf5_trouble").get_to(facts.hdf5_trouble);
    if (json.contains("rates")) facts.rates = extract::rates_from(json.at("rates").get<std::string>());
    return facts;
  } catch (const Json::exception&) {
    throw Error(ErrorCode::kEngine, "the engine's answer cannot be read: " + text,
                "footwall and footwall-engine must be of the same version");
  }
}

EngineFacts check_engine(const LaunchOptions& options, const std::filesystem::path& folder,
                         const JobContext& job) {
  job.check();
  const auto end = std::chrono::steady_clock::now() + kPatience;
  // The same launcher as a job's, with another word behind it.
  const PrivateFolder for_mpi(home_in_memory());
  const Launcher launcher =
      choose_launcher(options.ranks > 0 ? options.ranks : default_ranks(),
                      options.threads > 0 ? options.threads : default_threads(), for_mpi.path());
  std::vector<std::string> command = launcher.words;
  command.insert(command.end(),
                 {engine_program(options).string(), "check", std::filesystem::absolute(folder).string()});
  Child child(command, launcher.settings);
  // A launcher of another MPI starts every rank as a world of its own: several answers, of one rank each.
  std::optional<EngineFacts> answer;
  std::string last_words;
  const auto line = [&](const std::string& text) {
    if (text.starts_with(kMark)) {
      answer = engine_facts_from(text);
    } else if (last_words.size() < 500) {
      last_words += (last_words.empty() ? "" : " | ") + text.substr(0, 200);
    }
  };
  // Leaving by an exception kills the launcher.
  while (child.read_lines(100, line)) {
    job.check();
    if (std::chrono::steady_clock::now() > end) {
      throw Error(
          ErrorCode::kEngine, fmt::format("{} has not ended after {} s", command.front(), kPatience.count()),
          last_words.empty() ? "is the network up, and the host's name known?" : "its words: " + last_words);
    }
  }
  const int status = child.wait();
  if (answer && WIFEXITED(status) && WEXITSTATUS(status) == 0) return *answer;
  throw Error(ErrorCode::kEngine,
              fmt::format("{} {}", fmt::join(command, " "),
                          WIFEXITED(status) ? fmt::format("ended with exit status {}", WEXITSTATUS(status))
                                            : fmt::format("was killed by signal {}", WTERMSIG(status))),
              last_words.empty() ? "" : "its words: " + last_words);
}

}  // namespace footwall::session
