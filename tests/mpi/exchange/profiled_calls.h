// What the program really gives to MPI: its calls as MPI's profiling layer sees them.
#pragma once
#include <cstdint>

namespace footwall {

struct ProfiledCalls {
  std::int64_t bytes = 0;     // to other ranks: of sends, and of the sizes that all tell all
  std::int64_t messages = 0;  // the same
};

// Since the program began, on this rank.
ProfiledCalls profiled_calls();

}  // namespace footwall
