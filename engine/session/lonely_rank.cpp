#include "engine/session/lonely_rank.h"

#include <cstdlib>
#include <string>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::session {

int started_together() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS", "SLURM_NTASKS"}) {
    const char* value = std::getenv(name);
    const auto number = value != nullptr ? text::integer(value) : std::nullopt;
    if (number && *number >= 1 && *number < (1 << 30)) return static_cast<int>(*number);
  }
  return 1;
}

void refuse_lonely_rank(int world_size) {
  const int started = started_together();
  if (world_size > 1 || started == 1) return;
  throw Error(
      ErrorCode::kEngine,
      std::to_string(started) +
          " tasks were started, but MPI sees only this one: each would write the whole result",
      "start them with srun --mpi=pmix (srun --mpi=list shows what there is), or with the mpirun of the "
      "MPI library that footwall-engine was built with");
}

}  // namespace footwall::session
