#include "ui/model/history_jump.h"

#include <QCoreApplication>
#include <algorithm>

#include "ui/model/project_job.h"

namespace footwall::ui {

// What is passed in less time than a frame takes.
constexpr std::ptrdiff_t kAtOnce = 20;

void jump_to_step(Workbench& workbench, Id step) {
  Document& document = workbench.document;
  const auto is_passed = [step](const project::HistoryStep& one) { return (one.id > step) != one.undone; };
  if (std::ranges::count_if(document.history(), is_passed) <= kAtOnce) {
    document.go_to_step(step);
    return;
  }
  start_on_project(
      workbench, QCoreApplication::translate("jump_to_step", "Go to a step of the history"),
      [step](project::Project& project, const JobContext& job) { project.go_to_step(step, job); });
}

}  // namespace footwall::ui
