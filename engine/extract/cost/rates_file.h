// Rates of this machine, kept between runs in the user's cache folder: one file for each host, MPI library
// and number of ranks, readable by the user alone. A file that is damaged, of another version or of another
// machine is ignored and written again.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "engine/extract/cost/rates.h"

namespace footwall::extract {

struct RatesKey {
  std::string host;
  std::string mpi;           // the library, e.g. "Open MPI v4.1.4"
  std::string computations;  // those that were measured
  int ranks = 1;
  int cores = 1;
};

// $XDG_CACHE_HOME/footwall, else $HOME/.cache/footwall; empty where neither is set.
std::filesystem::path rates_folder();
std::filesystem::path rates_path(const std::filesystem::path& folder, const RatesKey& key);

// Nothing where there is none that is whole, of this version and of this key.
std::optional<MachineRates> read_rates(const std::filesystem::path& folder, const RatesKey& key);
// Whether it was kept: a cache that cannot be written is no error.
bool write_rates(const std::filesystem::path& folder, const RatesKey& key, const MachineRates& rates);

}  // namespace footwall::extract
