// Does the engine work on this machine? Its ranks start, talk to each other, and write and read one HDF5 file
// together.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/extract/cost/rates.h"
#include "engine/session/launch.h"
#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::comm {
class Communicator;
}

namespace footwall::session {

struct EngineFacts {
  int ranks = 0;  // the size of the world: 1 where launcher and library do not belong together
  std::vector<std::string> mpi_library;  // the different ones among the ranks, e.g. "Open MPI v4.1.4"
  std::string mpi_compiled;              // of the headers, e.g. "Open MPI 4.1.4"
  std::string mpi_standard;              // of the library, e.g. "3.1"
  std::string hdf5_compiled, hdf5_running;
  std::string hdf5_trouble;  // why parallel HDF5 does not work in the folder; empty when it does
  std::optional<extract::MachineRates> rates;  // measured just now, and kept for `auto`
};

// Starts `footwall-engine check FOLDER` on options.ranks ranks; a launcher that has not ended after a minute
// is ended. Throws kEngine with the launcher's last words; kCancelled.
EngineFacts check_engine(const LaunchOptions& options, const std::filesystem::path& folder,
                         const JobContext& job);

// On the ranks. Collective; throws kEngine where they do not reach each other.
EngineFacts check_ranks(const comm::Communicator& world, const std::filesystem::path& folder);

// The line that rank 0 prints, and back; throws kEngine for anything else.
std::string to_json(const EngineFacts& facts);
EngineFacts engine_facts_from(const std::string& json);

}  // namespace footwall::session
