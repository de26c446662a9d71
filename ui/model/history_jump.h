// Clicks on a step of the history.
#pragma once
#include "ui/model/workbench.h"

namespace footwall::ui {

// To the state after the step of this number (0: before the first): a few steps at once, many as a job.
void jump_to_step(Workbench& workbench, Id step);

}  // namespace footwall::ui
