// EXTRACT-ALL over the open project, as a job: what the window calls "Update all" and "Run".
#pragma once
#include <functional>

#include "engine/tasks/extract_run.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

// The faces are gathered (stale meshes made anew) before this returns; the engine runs under the job,
// cancelled with it; the result becomes a run of the project in the window's thread. The link's engine does
// the work where one runs and no number of ranks is asked for. Returns the job's number. Throws what
// tasks::prepare_run() throws; later failures come as Jobs::finished, and what attaching refuses as
// Document::failed. done gets the run's id.
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
