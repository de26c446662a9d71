#include "app/footwall-engine/check_command.h"

#include <cstdio>

#include "engine/session/self_check.h"

namespace footwall::app {

void check(const comm::Communicator& world, const std::filesystem::path& folder) {
  const std::string line = session::to_json(session::check_ranks(world, folder));
  if (world.rank() != 0) return;
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

}  // namespace footwall::app
