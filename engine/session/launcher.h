// How the ranks of a job are started here: what a batch system granted, and the command in front of the
// engine's. No MPI calls.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace footwall::session {

// What Slurm granted to this process; nothing is set outside an allocation.
struct Allocation {
  bool slurm = false;    // inside an allocation
  bool in_step = false;  // this process is itself part of a step (srun, salloc's shell)
  int step_tasks = 1;    // ... of so many tasks
  int nodes = 1;
  std::optional<int> tasks;                        // SLURM_NTASKS
  std::optional<int> cpus_per_task;                // SLURM_CPUS_PER_TASK
  std::optional<std::int64_t> megabytes_per_cpu;   // SLURM_MEM_PER_CPU
  std::optional<std::int64_t> megabytes_per_node;  // SLURM_MEM_PER_NODE
};
// From the environment of this process.
Allocation current_allocation();

// The plugin of `srun --mpi=list` that starts our ranks: "pmix", else "pmi2"; nothing where the list has
// neither.
std::optional<std::string> mpi_plugin_in(std::string_view list);

struct Launcher {
  std::vector<std::string> words;     // the command in front of the engine's
  std::vector<std::string> settings;  // "NAME=value" for its environment
  std::string why;                    // in words, for --dry-run: "srun, because ..."
};

// FOOTWALL_LAUNCHER's words where it is set ("{ranks}" and "{threads}" replaced); in an allocation srun, if
// it offers pmix or pmi2; else the mpirun of the MPI library
// that this was built with. `folder`: where MPI may keep session and shared-memory files of this
// run, on this host; may be empty. Asks `srun --mpi=list` (at most 10 s). Throws Error kEngine where this
// process is one of several tasks of a step: each would start a job of its own.
Launcher choose_launcher(int ranks, int threads, const std::filesystem::path& folder);

}  // namespace footwall::session
