#include "ui/model/update_all.h"
#include "ui/window/action_groups.h"
#include "ui/window/dialogs.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

void update_all(MainWindow& window) {
  try {
    start_update(*window.workbench());
  } catch (const Error& error) {
    window.tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  }
}

void cancel_jobs(MainWindow& window) {
  for (Jobs* jobs : {&window.workbench()->jobs, &window.start_jobs()}) {
    for (int row = 0; row < jobs->rowCount(); ++row)
      jobs->cancel(jobs->index(row).data(Jobs::kNumber).toInt());
  }
}

bool runs(MainWindow& window) {
  const EngineLink::State state = window.workbench()->engine.state();
  return state != EngineLink::State::kOff && state != EngineLink::State::kLost;
}

void switch_engine(MainWindow& window) {
  if (runs(window)) {
    window.workbench()->engine.stop();
  } else {
    window.workbench()->engine.start();
  }
}

}  // namespace

std::vector<ActionRow> compute_actions() {
  using M = Menu;
  return {
      {"compute.update-all", M::kCompute, QT_TRANSLATE_NOOP("Actions", "&Update all"), "Ctrl+U F5", "update",
       QT_TRANSLATE_NOOP("Actions",
                         "Statistics of all faces of all faults, from the volume shown, kept in the project"),
       kProject | kSurvey | kVolume, update_all},
      {"compute.run", M::kCompute, QT_TRANSLATE_NOOP("Actions", "&Run…"), "Ctrl+Alt+U", "update",
       QT_TRANSLATE_NOOP("Actions", "Statistics of all or selected faults as a run that is kept, by a job"),
       kProject | kWriting | kSurvey | kVolume | kFaults, open_run_dialog},
      {"compute.compare", M::kCompute, QT_TRANSLATE_NOOP("Actions", "Com&pare runs…"), "Ctrl+Alt+C",
       "compare",
       QT_TRANSLATE_NOOP("Actions",
                         "One statistic of a fault in two runs side by side, and their difference"),
       kProject | kSurvey, open_compare_dialog},
      {"compute.isosurface", M::kCompute, QT_TRANSLATE_NOOP("Actions", "&Isosurface…"), "Ctrl+Alt+O",
       "volume",
       QT_TRANSLATE_NOOP("Actions", "A surface of one value of the volume shown, which follows a slider"),
       kProject | kSurvey | kVolume, [](MainWindow& window) { open_isosurface_dialog(window, 0); }},
      {"compute.engine", M::kCompute, QT_TRANSLATE_NOOP("Actions", "&Engine"), "Ctrl+Alt+E", "engine",
       QT_TRANSLATE_NOOP("Actions", "Start the engine, which computes colours, or stop it"), kProject,
       switch_engine, runs, true},
      {"compute.cancel", M::kCompute, QT_TRANSLATE_NOOP("Actions", "&Cancel jobs"), "Ctrl+.", "stop",
       QT_TRANSLATE_NOOP("Actions", "Cancel all jobs that run"), kProject | kJob, cancel_jobs},
  };
}

}  // namespace footwall::ui
