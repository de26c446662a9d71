// Starts footwall-engine under a launcher for one batch job or another of its commands, and waits for it. No
// MPI in here: the command line and the editor use it.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::session {

class RunningEngine;

struct LaunchOptions {
  int ranks = 0;                 // 0 = default_ranks()
  int threads = 0;               // OpenMP threads of each rank; 0 = default_threads()
  std::filesystem::path engine;  // footwall-engine; empty = beside this program
  std::filesystem::path volume;  // where the volume is here; empty = where the job says
  // Does the tasks instead of ranks that would be started for each; the others are then of no meaning, but
  // for `volume`.
  std::shared_ptr<RunningEngine> running;
};

// Inside an allocation of Slurm its tasks; else min(4, cores that this process may use).
int default_ranks();
// Inside an allocation of Slurm the processors of a task; else 1.
int default_threads();
// Cores of the affinity mask, or the cgroup's CPU quota where that is smaller; at least 1.
int usable_cores();

// options.engine, or the one beside this program. Throws kEngine where that cannot be told.
std::filesystem::path engine_program(const LaunchOptions& options);

// The command that would run: the launcher's words (launcher.h), then the engine, "batch", the job.
std::vector<std::string> launch_command(const LaunchOptions& options, const std::filesystem::path& job);

// The launcher's words and what is run under it, and "NAME=value" for its environment. words: of
// footwall-engine, its command first. folder: of this run, for MPI's files; may be empty. Throws kEngine.
struct EngineCommand {
  std::vector<std::string> words;
  std::vector<std::string> settings;
};
EngineCommand engine_command(const LaunchOptions& options, const std::vector<std::string>& words,
                             const std::filesystem::path& folder);
// "was killed by signal 9 (Killed)", "ended with exit status 1": of a status as waitpid() gives it.
std::string how_it_ended(int status);

// The job's ranks were told to make room (SIGTERM or SIGUSR1 from a batch system): what is done is kept, and
// the next run goes on from there. Its code is kCancelled.
class Preempted : public Error {
 public:
  explicit Preempted(const Error& error) : Error(error) {}
};

// A command of footwall-engine that leaves one file with its answer when all went well.
struct EngineTask {
  std::vector<std::string> words;  // the command and what follows, as {"batch", "/jobs/JOB.json"}
  std::filesystem::path result;    // one that stands there before is removed
};

// An engine that is there already, and does tasks one after the other.
class RunningEngine {
 public:
  virtual ~RunningEngine() = default;
  // As run_engine() below, which calls it. Every file of the job is read and written on this machine,
  // wherever the engine is.
  virtual std::string run(const EngineTask& task, const LaunchOptions& options, const JobContext& job) = 0;
};

// Runs the task and returns the text of its result. Progress of the ranks is reported to `job`,
// its cancel is passed on (the ranks get SIGUSR2, the launcher SIGTERM after 5 s, and all are killed after
// 10 s). Blocks; the engine dies with the calling thread. Throws the engine's own Error; kCancelled;
// Preempted; kEngine where the launcher cannot be started or the engine ended without an answer, saying how.
// options.volume is of no meaning here.
std::string run_engine(const LaunchOptions& options, const EngineTask& task, const JobContext& job);

// The same for `batch` and a job: the text of result.json (see batch.h).
std::string run_engine(const LaunchOptions& options, const std::filesystem::path& job_path,
                       const JobContext& job);

}  // namespace footwall::session
