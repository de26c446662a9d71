#include "engine/extract/machine_rates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

#include "engine/comm/calibrate.h"
#include "engine/comm/shared_text.h"
#include "engine/extract/computations.h"
#include "engine/extract/cost/rates_file.h"
#include "engine/extract/measure_rates.h"
#include "storage/base/cores.h"

namespace footwall::extract {
namespace {

constexpr double kLinkSeconds = 0.25;
constexpr double kComputingSeconds = 0.08;  // of every core

// Processors that the ranks may use, over all hosts: on each host those of any of its ranks, or its quota.
int cores_of(const comm::Communicator& world) {
  MPI_Comm shared = MPI_COMM_NULL;
  comm::check(MPI_Comm_split_type(world.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &shared),
              "MPI_Comm_split_type");
  const comm::Communicator host(shared);
  comm::check(MPI_Comm_free(&shared), "MPI_Comm_free");
  const std::vector<std::uint64_t> mine = affinity_mask();
  std::vector<std::uint64_t> all(mine.size());
  comm::check(
      MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_UINT64_T, MPI_BOR, host.get()),
      "MPI_Allreduce");
  const int allowed = std::accumulate(all.begin(), all.end(), 0,
                                      [](int sum, std::uint64_t word) { return sum + std::popcount(word); });
  const int cores = std::min(allowed, quota_cores().value_or(allowed));
  return static_cast<int>(world.sum(host.rank() == 0 ? cores : 0));
}

std::string host_name() {
  std::array<char, MPI_MAX_PROCESSOR_NAME + 1> name{};
  int length = 0;
  comm::check(MPI_Get_processor_name(name.data(), &length), "MPI_Get_processor_name");
  return {name.data(), static_cast<std::size_t>(length)};
}

std::string library() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  comm::check(MPI_Get_library_version(text.data(), &length), "MPI_Get_library_version");
  const std::string name(text.data(), static_cast<std::size_t>(length));
  return name.substr(0, name.find_first_of(",\n"));
}

RatesKey key_of(const comm::Communicator& world) {
  std::string measured;
  for (const Computation& computation : computations()) {
    if (computation.make != nullptr && computation.built) measured += std::string(computation.name) + " ";
  }
  return {host_name(), library(), measured, world.size(), cores_of(world)};
}

MachineRates measure(const comm::Communicator& world, int cores) {
  // All at once, as in an extraction, so that what they share slows them here, too. Ranks that take turns on
  // a core have less each.
  const double share = std::min(1.0, static_cast<double>(cores) / world.size());
  MachineRates rates = world.collectively([&] { return measure_computing(kComputingSeconds * share); });
  for (double MachineRates::*rate : {&MachineRates::voxelize, &MachineRates::gather, &MachineRates::fold,
                                     &MachineRates::fold_discontinuity, &MachineRates::pack,
                                     &MachineRates::face, &MachineRates::finish, &MachineRates::balance})
    rates.*rate = world.maximum(rates.*rate);
  for (MachineRates::WholeFace& each : rates.whole_face) each.voxel = world.maximum(each.voxel);
  std::sort(rates.whole_face.begin(), rates.whole_face.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });  // as they are kept
  const comm::LinkRates links = comm::measure_links(world, kLinkSeconds);
  rates.alpha = links.alpha;
  rates.overhead = links.overhead;
  rates.byte = links.byte;
  rates.ranks = world.size();
  rates.cores = cores;
  return rates;
}

void keep(const comm::Communicator& world, const std::filesystem::path& folder, const RatesKey& key,
          const MachineRates& rates) {
  world.collectively([&] {
    if (world.rank() == 0) write_rates(folder, key, rates);
  });
}

}  // namespace

MachineRates machine_rates(const comm::Communicator& world, const std::filesystem::path& folder) {
  const RatesKey key = key_of(world);
  const std::string kept = world.collectively([&] {
    const auto rates = world.rank() == 0 ? read_rates(folder, key) : std::nullopt;
    return rates ? to_text(*rates) : std::string();
  });
  const std::string text = comm::shared_text(world, kept);
  if (!text.empty()) return world.collectively([&] { return rates_from(text); });
  const MachineRates rates = measure(world, key.cores);
  keep(world, folder, key, rates);
  return rates;
}

MachineRates measured_rates(const comm::Communicator& world, const std::filesystem::path& folder) {
  const RatesKey key = key_of(world);
  const MachineRates rates = measure(world, key.cores);
  keep(world, folder, key, rates);
  return rates;
}

}  // namespace footwall::extract
