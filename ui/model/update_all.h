// "Update all": the engine computes the statistics of every face of every fault that are not known, and what
// is known then is kept in the project as the live run of the volume shown.
#pragma once
#include "ui/model/workbench.h"

namespace footwall::ui {

// A job: starts the engine where it does not run, waits until all faults that can be a surface are fresh, and
// stores them. One at a time: while one is under way its number is returned again. Cancelling it stops the
// waiting; the engine goes on with what it has. Fails with what the engine says, where it stops.
int start_update(Workbench& workbench);

}  // namespace footwall::ui
