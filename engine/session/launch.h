// Starts footwall-engine under mpirun for one batch job and waits for it. No MPI in here: the command line
// and the editor use it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/session/part_file.h"
#include "storage/base/job_context.h"

namespace footwall::session {

struct LaunchOptions {
  int ranks = 0;                 // 0 = default_ranks()
  int threads = 1;               // OpenMP threads of each rank
  std::filesystem::path engine;  // footwall-engine; empty = beside this program
};

// min(4, cores that this process may use).
int default_ranks();
// Cores of the affinity mask, or the cgroup's CPU quota where that is smaller; at least 1.
int usable_cores();

// The command that would run: mpirun and its options, or the words of FOOTWALL_LAUNCHER (split at blanks;
// "{ranks}" and "{threads}" are replaced, e.g. "srun -n {ranks} -c {threads}"), then the engine, "batch", the
// job.
std::vector<std::string> launch_command(const LaunchOptions& options, const std::filesystem::path& job);

// Runs the job and returns the text of result.json (see batch.h). Progress of the ranks is reported to `job`,
// its cancel is passed on (the ranks get SIGTERM, and are killed after 10 s). Blocks; the engine dies with
// the calling thread. Throws the engine's own Error; kCancelled; kEngine where the launcher cannot be started
// or the engine ended without an answer, saying how.
std::string run_engine(const LaunchOptions& options, const std::filesystem::path& job_path,
                       const JobContext& job);

}  // namespace footwall::session
