// EXTRACT-ALL over the open project, as a job: what the window calls "Run".
#pragma once
#include <functional>

#include "engine/tasks/extract_run.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

// All of it under the job, and cancelled with it: the faces are gathered (stale meshes made anew), the engine
// computes, the result becomes a run of the project. The link's engine does the work where one runs and no
// number of ranks is asked for. The survey's velocity is used unless options have one. Returns the job's
// number. Throws for a fault that is not there, for names that are not built or cannot be a run's, and for a
// project without faults; later failures come as Jobs::finished. done gets the run's id.
int start_run(Workbench& workbench, const tasks::ExtractOptions& options, std::function<void(Id)> done = {});

// Names of the registry that can be chosen, "auto" first; with what each does.
struct RunChoices {
  struct Choice {
    QString name, help;
  };
  std::vector<Choice> exchanges, balances;
};
RunChoices run_choices();

}  // namespace footwall::ui
