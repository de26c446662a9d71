// Several processes that were started together but do not know of each other would each compute everything
// and write the same files: that is refused.
#pragma once

namespace footwall::session {

// How many processes the launcher started, as the environment tells it: OMPI_COMM_WORLD_SIZE or PMI_SIZE (set
// by a launcher that speaks to MPI), else SLURM_STEP_NUM_TASKS or SLURM_NTASKS; 1 where none is set.
int started_together();
// Throws Error kEngine where MPI sees one rank and the launcher started more.
void refuse_lonely_rank(int world_size);

}  // namespace footwall::session
