#include "ui/dialogs/run_job.h"

#include <algorithm>
#include <utility>

#include "engine/extract/registry.h"
#include "engine/service/client/running_tasks.h"
#include "ui/model/project_job.h"

namespace footwall::ui {
namespace {

struct Ended {
  Id run = 0;
  std::set<Id> remade;  // faults whose meshes were made first
};

std::vector<RunChoices::Choice> choices_of(std::span<const extract::Row> rows) {
  std::vector<RunChoices::Choice> choices;
  for (const extract::Row& row : rows) {
    if (!row.built) continue;
    choices.push_back({QString::fromUtf8(row.name.data(), static_cast<qsizetype>(row.name.size())),
                       QString::fromUtf8(row.help.data(), static_cast<qsizetype>(row.help.size()))});
  }
  std::stable_partition(choices.begin(), choices.end(),
                        [](const auto& choice) { return choice.name == QLatin1String("auto"); });
  return choices;
}

}  // namespace

RunChoices run_choices() {
  return {choices_of(extract::exchange_rows()), choices_of(extract::balance_rows())};
}

int start_run(Workbench& workbench, const tasks::ExtractOptions& options, std::function<void(Id)> done) {
  Document& document = workbench.document;
  const std::size_t faults = tasks::faults_of(document.project(), options).size();
  extract::validate(options.engine);
  if (!options.name.empty()) project::check_name("run", options.name);
  const QString title = !options.faults.empty() ? QObject::tr("Statistics of %1 faults").arg(faults)
                        : options.fault.empty()
                            ? QObject::tr("Statistics of all faults")
                            : QObject::tr("Statistics of %1").arg(QString::fromStdString(options.fault));
  tasks::ExtractOptions chosen = options;
  if (!chosen.velocity) chosen.velocity = document.velocity();
  if (const auto connection = workbench.engine.connection(); connection && chosen.launch.ranks == 0) {
    chosen.launch.running = service::running_tasks(*connection);
  }
  auto ended = std::make_shared<Ended>();
  const auto work = [ended, chosen](project::Project& project, const JobContext& job) {
    const tasks::PreparedRun prepared = tasks::prepare_run(project, chosen, job.part(0, 0.05));
    if (!prepared.made.triangulated.empty()) {
      for (const session::JobFault& fault : prepared.made.job.faults) ended->remade.insert(fault.id);
    }
    std::string result = tasks::launch_run(prepared, chosen.launch, job.part(0.05, 0.98));
    ended->run = tasks::attach_run(project, prepared, std::move(result)).run;
  };
  return start_on_project(workbench, title, work, [&document, ended, done = std::move(done)] {
    if (!ended->remade.empty()) Q_EMIT document.meshes_changed(ended->remade);
    if (done) done(ended->run);
  });
}

}  // namespace footwall::ui
