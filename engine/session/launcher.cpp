#include "engine/session/launcher.h"

#include <mpi.h>  // only for the name of the library
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "engine/session/child.h"
#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::session {
namespace {

#ifdef OPEN_MPI
constexpr bool kOpenMpi = true;
#else
constexpr bool kOpenMpi = false;
#endif

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::optional<std::int64_t> positive(const char* name) {
  const auto number = text::integer(variable(name));
  return number && *number >= 1 ? number : std::nullopt;
}

std::optional<int> small(const char* name) {
  const auto number = positive(name);
  return number && *number < (1 << 20) ? std::optional<int>(static_cast<int>(*number)) : std::nullopt;
}

std::string replaced(std::string word, const std::string& name, int value) {
  for (std::size_t at = word.find(name); at != std::string::npos; at = word.find(name, at)) {
    word.replace(at, name.size(), std::to_string(value));
  }
  return word;
}

// What `srun --mpi=list` prints; empty where there is no srun, or it does not answer.
std::string offered_plugins() {
  constexpr std::chrono::seconds kPatience(10);
  std::string all;
  try {
    Child child({"srun", "--mpi=list"}, {});
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (child.read_lines(100, [&](const std::string& line) { all += line + "\n"; })) {
      if (std::chrono::steady_clock::now() > end) return "";
    }
  } catch (const Error&) {
    return "";  // there is no srun: mpirun does it
  }
  return all;
}

// The launcher of the MPI library that this was built with: where several are installed, plain "mpirun" may
// be that of another, under which every rank is a world of its own. On a machine that has it elsewhere, by
// its name.
std::string launcher_of_the_library() {
  const std::filesystem::path built_with = FOOTWALL_MPIEXEC;
  return access(built_with.c_str(), X_OK) == 0 ? built_with.string() : built_with.filename().string();
}

// Whether mpirun would start ranks on other hosts, where a folder of ours does not exist.
bool may_leave_this_host(const Allocation& allocation) {
  if (allocation.slurm) return allocation.nodes > 1;
  for (const char* hosts : {"PBS_NODEFILE", "LSB_DJOB_HOSTFILE", "PE_HOSTFILE"}) {
    if (!variable(hosts).empty()) return true;
  }
  return false;
}

Launcher with_mpirun(int ranks, const std::filesystem::path& folder) {
  Launcher launcher;
  const std::string number = std::to_string(ranks);
  if (!kOpenMpi) {
    launcher.words = {launcher_of_the_library(), "-n", number};
    return launcher;
  }
  // Without binding, threads of a rank may use all of its cores. Slots are counted in cores, but a rank may
  // well run on a hardware thread: hence --oversubscribe, always. The single-copy path is the slower one.
  // Ranks that wait give way to others: on a machine that somebody else uses too, two ranks on two cores that
  // do not took four times as long. Ranks leave together, as the last thing that they do is a fence: when the
  // first has left with an error, mpirun need not give the others a second before it kills them, and another
  // one before it ends.
  launcher.words = {launcher_of_the_library(),
                    "-n",
                    number,
                    "--bind-to",
                    "none",
                    "--oversubscribe",
                    "--mca",
                    "btl_vader_single_copy_mechanism",
                    "none",
                    "--mca",
                    "mpi_yield_when_idle",
                    "1",
                    "--mca",
                    "odls_base_sigkill_timeout",
                    "0"};
  if (!folder.empty()) {
    for (const char* name : {"orte_tmpdir_base", "btl_vader_backing_directory"}) {
      launcher.words.insert(launcher.words.end(), {"--mca", name, folder.string()});
    }
  }
  if (geteuid() == 0) launcher.settings = {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
  return launcher;
}

Launcher with_srun(const Allocation& allocation, const std::string& plugin, int ranks, int threads) {
  Launcher launcher;
  launcher.words = {"srun", "--mpi=" + plugin, "--ntasks=" + std::to_string(ranks),
                    "--cpus-per-task=" + std::to_string(threads), "--kill-on-bad-exit=1"};
  if (allocation.in_step) launcher.words.emplace_back("--overlap");
  if (kOpenMpi)
    launcher.settings = {"OMPI_MCA_btl_vader_single_copy_mechanism=none", "OMPI_MCA_mpi_yield_when_idle=1"};
  launcher.why = "inside Slurm's allocation " + variable("SLURM_JOB_ID") + ", where srun offers " + plugin;
  return launcher;
}

}  // namespace

Allocation current_allocation() {
  Allocation allocation;
  if (variable("SLURM_JOB_ID").empty()) return allocation;
  allocation.slurm = true;
  allocation.in_step = !variable("SLURM_STEP_ID").empty();
  if (allocation.in_step) allocation.step_tasks = small("SLURM_STEP_NUM_TASKS").value_or(1);
  allocation.nodes = small("SLURM_JOB_NUM_NODES").value_or(1);
  allocation.tasks = small("SLURM_NTASKS");
  allocation.cpus_per_task = small("SLURM_CPUS_PER_TASK");
  allocation.megabytes_per_cpu = positive("SLURM_MEM_PER_CPU");
  allocation.megabytes_per_node = positive("SLURM_MEM_PER_NODE");
  return allocation;
}

std::optional<std::string> mpi_plugin_in(std::string_view list) {
  bool pmi2 = false;
  // One name a line, some with a version: "pmix_v4"; words in front: "specific pmix plugin versions
  // available:".
  for (const std::string_view line : text::split(list, '\n')) {
    const auto words = text::words(line);
    if (words.empty()) continue;
    // Older ones put "srun:" in front.
    if (words.size() > 2 || (words.size() == 2 && words.front() != "srun:")) continue;
    const std::string_view name = words.back();
    if (name == "pmix" || name.starts_with("pmix_")) return "pmix";
    pmi2 = pmi2 || name == "pmi2";
  }
  return pmi2 ? std::optional<std::string>("pmi2") : std::nullopt;
}

Launcher choose_launcher(int ranks, int threads, const std::filesystem::path& folder) {
  const Allocation allocation = current_allocation();
  if (allocation.step_tasks > 1) {
    throw Error(ErrorCode::kEngine,
                "this program was started " + std::to_string(allocation.step_tasks) +
                    " times by srun: each would start a job of its own",
                "start it once, without srun or with srun -n 1: it starts the ranks itself");
  }
  Launcher launcher;
  if (const std::string custom = variable("FOOTWALL_LAUNCHER"); !text::words(custom).empty()) {
    for (const std::string_view word : text::words(custom)) {
      launcher.words.push_back(replaced(replaced(std::string(word), "{ranks}", ranks), "{threads}", threads));
    }
    launcher.why = "FOOTWALL_LAUNCHER says so";
    // Words of ours that mpirun takes, should it be behind them.
    if (kOpenMpi && geteuid() == 0)
      launcher.settings = {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
  } else {
    const auto plugin = allocation.slurm ? mpi_plugin_in(offered_plugins()) : std::nullopt;
    if (plugin) {
      launcher = with_srun(allocation, *plugin, ranks, threads);
    } else {
      launcher = with_mpirun(ranks, may_leave_this_host(allocation) ? "" : folder);
      launcher.why = allocation.slurm ? "srun offers neither pmix nor pmi2" : "no batch system's allocation";
    }
  }
  return launcher;
}

}  // namespace footwall::session
