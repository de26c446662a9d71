#include "engine/tasks/doctor/engine_check.h"

#include <fmt/format.h>

#include <chrono>

namespace footwall::tasks {
namespace {

constexpr int kRanks = 2;

// The two families of MPI libraries cannot stand in for each other; within one they can.
bool is_open_mpi(const std::string& name) {
  return name.starts_with("Open MPI");
}

}  // namespace

Finding ranks_finding(const session::EngineFacts& facts, int ranks, double seconds) {
  if (facts.ranks == ranks)
    return ok(fmt::format("{} ranks start, and reach each other ({:.1f} s)", ranks, seconds));
  return failed(
      fmt::format("the launcher started {} ranks, and each found itself in a world of {}", ranks,
                  facts.ranks),
      fmt::format("the launcher belongs to another MPI than the engine's ({}): name the right one in "
                  "FOOTWALL_LAUNCHER, e.g. \"mpiexec -n {{ranks}}\" with its path",
                  facts.mpi_compiled));
}

Finding mpi_finding(const session::EngineFacts& facts) {
  const std::string libraries = fmt::format("{}", fmt::join(facts.mpi_library, " and "));
  if (facts.mpi_library.size() != 1) {
    return failed(fmt::format("the ranks run with different libraries: {}", libraries),
                  "load the same MPI module on every node");
  }
  if (is_open_mpi(libraries) != is_open_mpi(facts.mpi_compiled)) {
    return failed(fmt::format("the engine was built with {} and runs with {}", facts.mpi_compiled, libraries),
                  "load the MPI that it was built with, or build it again");
  }
  return ok(fmt::format("{} on every rank, MPI {}, built with {}", libraries, facts.mpi_standard,
                        facts.mpi_compiled));
}

Finding hdf5_finding(const session::EngineFacts& facts) {
  if (!facts.hdf5_trouble.empty()) {
    return failed(facts.hdf5_trouble, "try footwall doctor --path with a folder on another disk");
  }
  if (facts.hdf5_compiled != facts.hdf5_running) {
    return failed(
        fmt::format("built with HDF5 {}, and runs with {}", facts.hdf5_compiled, facts.hdf5_running),
        "load the HDF5 that the engine was built with, or build it again");
  }
  return ok(fmt::format("HDF5 {}: the ranks wrote one file together and read it back", facts.hdf5_running));
}

std::optional<session::EngineFacts> check_engine_rows(Checkup& checkup, const session::LaunchOptions& launch,
                                                      const std::filesystem::path& folder) {
  session::LaunchOptions two = launch;
  two.ranks = kRanks;
  two.threads = 1;
  session::EngineFacts facts;
  const bool started = checkup.run("engine", [&] {
    const auto start = std::chrono::steady_clock::now();
    facts = session::check_engine(two, folder, checkup.job());
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return ranks_finding(facts, kRanks, passed.count());
  });
  if (!started) return std::nullopt;
  checkup.run("MPI library", [&] { return mpi_finding(facts); });
  checkup.run("parallel HDF5", [&] { return hdf5_finding(facts); });
  return facts;
}

}  // namespace footwall::tasks
