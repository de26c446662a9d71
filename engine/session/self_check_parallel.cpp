#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>

#include "engine/comm/communicator.h"
#include "engine/extract/cost/rates_file.h"
#include "engine/extract/machine_rates.h"
#include "engine/session/self_check.h"
#include "storage/volume/probe_parallel.h"

namespace footwall::session {
namespace {

// The first line of what the library calls itself, up to the first comma: "Open MPI v4.1.4".
std::string library_name() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  comm::check(MPI_Get_library_version(text, &length), "MPI_Get_library_version");
  std::string name(text, static_cast<std::size_t>(length));
  name = name.substr(0, name.find_first_of(",\n"));
  std::replace(name.begin(), name.end(), '\t', ' ');
  while (name.ends_with(' ')) name.pop_back();
  return name;
}

std::string compiled_with() {
#if defined(OMPI_MAJOR_VERSION)
  return fmt::format("Open MPI {}.{}.{}", OMPI_MAJOR_VERSION, OMPI_MINOR_VERSION, OMPI_RELEASE_VERSION);
#elif defined(MPICH_VERSION)
  return "MPICH " MPICH_VERSION;
#else
  return fmt::format("MPI {}.{}", MPI_VERSION, MPI_SUBVERSION);
#endif
}

}  // namespace

EngineFacts check_ranks(const comm::Communicator& world, const std::filesystem::path& folder) {
  EngineFacts facts;
  facts.ranks = world.size();
  facts.mpi_compiled = compiled_with();
  int version = 0;
  int subversion = 0;
  comm::check(MPI_Get_version(&version, &subversion), "MPI_Get_version");
  facts.mpi_standard = fmt::format("{}.{}", version, subversion);

  // 1. Every rank is heard.
  const std::int64_t n = world.size();
  const std::int64_t sum = world.sum(world.rank() + 1);
  world.collectively([&] {
    if (sum == n * (n + 1) / 2) return;
    throw Error(ErrorCode::kEngine,
                fmt::format("the ranks' numbers add up to {}, not {}", sum, n * (n + 1) / 2),
                "the MPI library does not work here");
  });

  // 2. All have the same library.
  const std::string mine = library_name();
  for (int rank = 0; rank < world.size(); ++rank) {
    const auto* begin = reinterpret_cast<const std::byte*>(mine.data());
    const comm::Bytes theirs = world.broadcast({begin, begin + mine.size()}, rank);
    const std::string name(reinterpret_cast<const char*>(theirs.data()), theirs.size());
    if (std::find(facts.mpi_library.begin(), facts.mpi_library.end(), name) == facts.mpi_library.end())
      facts.mpi_library.push_back(name);
  }

  // 3. One file by all of them.
  const volume::HdfVersions hdf5 = volume::hdf5_versions();
  facts.hdf5_compiled = hdf5.compiled;
  facts.hdf5_running = hdf5.running;
  try {
    volume::probe_parallel_hdf5(world.get(), folder / "probe.h5");
  } catch (const Error& error) {
    facts.hdf5_trouble = error.message();  // the same on all ranks
  }

  // 4. How fast they are.
  facts.rates = extract::measured_rates(world, extract::rates_folder());
  return facts;
}

}  // namespace footwall::session
