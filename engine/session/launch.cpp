#include "engine/session/launch.h"

#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstring>
#include <deque>
#include <nlohmann/json.hpp>

#include "engine/session/batch.h"
#include "engine/session/child.h"
#include "engine/session/job.h"
#include "engine/session/launcher.h"
#include "engine/session/private_folder.h"
#include "storage/base/error.h"
#include "storage/base/log.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kResultLimit = std::size_t{256} << 20;
constexpr std::size_t kKeptLines = 12;

int ranks_of(const LaunchOptions& options) {
  return options.ranks > 0 ? options.ranks : default_ranks();
}
int threads_of(const LaunchOptions& options) {
  return options.threads > 0 ? options.threads : default_threads();
}

std::vector<std::string> batch_words(const LaunchOptions& options, const std::filesystem::path& job) {
  std::vector<std::string> words{"batch", std::filesystem::absolute(job).string()};
  if (!options.volume.empty()) {
    words.insert(words.end(), {"--volume", std::filesystem::absolute(options.volume).string()});
  }
  if (options.threads > 0) words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  return words;
}

// What the engine says on its output, line by line.
class Listener {
 public:
  explicit Listener(const JobContext& job) : job_(job) {}

  void line(const std::string& text) {
    // Where mpirun prints first, its words may stand before a rank's line.
    const Json json = text.front() == '{' ? Json::parse(text, nullptr, false) : Json();
    if (json.is_object() && json.contains("progress")) {
      progress(json["progress"]);
    } else if (json.is_object() && json.contains("error") && json["error"].is_object()) {
      const Json& error = json["error"];
      if (!error_) {
        error_.emplace(error_code_from(error.value("code", "internal")), error.value("message", "unknown"),
                       error.value("hint", ""));
      }
    } else {
      if (last_.size() == kKeptLines) last_.pop_front();
      last_.push_back(text);
    }
  }

  const std::optional<Error>& error() const { return error_; }
  std::string last_words() const {
    std::string words;
    for (const std::string& each : last_) words += (words.empty() ? "" : " | ") + each;
    return words;
  }

 private:
  void progress(const Json& json) const {
    if (!json.is_object() || job_.cancelled()) return;
    try {
      const std::string phase = json.value("phase", "");
      job_.report(json.value("fraction", 0.0), phase, json.value("amounts", ""));
    } catch (const Error& error) {
      // The cancel is passed on by the loop that reads.
      if (error.code() != ErrorCode::kCancelled) throw;
    } catch (const Json::exception&) {
      log::warn("the engine sent a line of progress that cannot be read");
    }
  }

  const JobContext& job_;
  std::optional<Error> error_;
  std::deque<std::string> last_;
};

// Asks the ranks to stop, then mpirun, then kills.
class Stopper {
 public:
  void step(const Child& child) {
    const auto now = Clock::now();
    if (stage_ == 0) {
      // mpirun passes SIGUSR2 on to the ranks, who agree to cancel and leave in order.
      child.signal(SIGUSR2);
    } else if (now < next_) {
      return;
    } else if (stage_ == 1) {
      child.signal(SIGTERM);
    } else {
      child.kill_group();
    }
    ++stage_;
    next_ = now + std::chrono::seconds(5);
  }

 private:
  int stage_ = 0;
  Clock::time_point next_;
};

}  // namespace

std::filesystem::path engine_program(const LaunchOptions& options) {
  if (!options.engine.empty()) return options.engine;
  std::error_code failure;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failure);
  if (failure) throw Error(ErrorCode::kEngine, "cannot tell where this program is", "name the engine's path");
  return self.parent_path() / "footwall-engine";
}

EngineCommand engine_command(const LaunchOptions& options, const std::vector<std::string>& words,
                             const std::filesystem::path& folder) {
  Launcher launcher = choose_launcher(ranks_of(options), threads_of(options), folder);
  EngineCommand command{std::move(launcher.words), std::move(launcher.settings)};
  command.words.push_back(engine_program(options).string());
  command.words.insert(command.words.end(), words.begin(), words.end());
  return command;
}

std::vector<std::string> launch_command(const LaunchOptions& options, const std::filesystem::path& job) {
  return engine_command(options, batch_words(options, job), {}).words;
}

std::string how_it_ended(int status) {
  // mpirun ends with 128 + n where a rank was killed by signal n.
  int signal = 0;
  if (WIFSIGNALED(status)) signal = WTERMSIG(status);
  if (WIFEXITED(status) && WEXITSTATUS(status) > 128) signal = WEXITSTATUS(status) - 128;
  if (signal > 0 && signal < 65) {
    return "was killed by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
  }
  return "ended with exit status " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

std::string run_engine(const LaunchOptions& options, const std::filesystem::path& job_path,
                       const JobContext& job) {
  job.check();
  return run_engine(options, {batch_words(options, job_path), output_of(job_path) / "result.json"}, job);
}

std::string run_engine(const LaunchOptions& options, const EngineTask& task, const JobContext& job) {
  job.check();
  const std::filesystem::path& result = task.result;
  std::error_code ignored;
  std::filesystem::remove(result, ignored);  // an older one must not be taken for this run's
  if (options.running) return options.running->run(task, options, job);
  const PrivateFolder folder(home_in_memory());
  const EngineCommand command = engine_command(options, task.words, folder.path());
  Child child(command.words, command.settings);
  Listener listener(job);
  Stopper stopper;
  while (child.read_lines(100, [&](const std::string& line) { listener.line(line); })) {
    if (job.cancelled()) stopper.step(child);
  }
  const int status = child.wait();
  // A cancel may arrive when the result has just been written, or the launcher may hold it back until the
  // ranks are done; who was told "cancelled" must not find a result.
  if (job.cancelled()) std::filesystem::remove(result, ignored);
  job.check();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    if (std::filesystem::exists(result)) return read_whole_file(result, kResultLimit);
    throw Error(ErrorCode::kEngine, "the engine ended without a result", listener.last_words());
  }
  // srun and mpirun end with the status of the ranks; one that was told before it could listen was killed by
  // it.
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code == kResumable || code == 128 + SIGTERM || code == 128 + SIGUSR1) {
    throw Preempted(listener.error().value_or(Error(ErrorCode::kCancelled, "the ranks were told to stop")));
  }
  if (listener.error()) throw *listener.error();
  const std::string words = listener.last_words();
  throw Error(ErrorCode::kEngine, "the engine " + how_it_ended(status),
              words.empty() ? "run the job again, or with fewer ranks" : "its last words: " + words);
}

}  // namespace footwall::session
