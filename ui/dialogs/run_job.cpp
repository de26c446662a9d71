#include "ui/dialogs/run_job.h"

#include <algorithm>
#include <utility>

#include "engine/extract/registry.h"
#include "engine/service/client/running_tasks.h"

namespace footwall::ui {
namespace {

struct Run {
  tasks::PreparedRun prepared;
  std::string result;
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
  auto run = std::make_shared<Run>();
  run->prepared = tasks::prepare_run(document.store(), options, {});
  if (!run->prepared.made.triangulated.empty()) {
    std::set<Id> remade;
    for (const session::JobFault& fault : run->prepared.made.job.faults) remade.insert(fault.id);
    Q_EMIT document.meshes_changed(remade);
  }
  const QString title = options.fault.empty()
                            ? QObject::tr("Statistics of all faults")
                            : QObject::tr("Statistics of %1").arg(QString::fromStdString(options.fault));
  session::LaunchOptions launch = options.launch;
  if (const auto connection = workbench.engine.connection(); connection && launch.ranks == 0) {
    launch.running = service::running_tasks(*connection);
  }
  const auto work = [run, launch](const JobContext& job) {
    run->result = tasks::launch_run(run->prepared, launch, job);
  };
  return workbench.jobs.start(title, work, [&document, run, done = std::move(done)] {
    try {
      const Id id = tasks::attach_run(document.store(), run->prepared, run->result).run;
      Q_EMIT document.runs_changed();
      if (done) done(id);
    } catch (const Error& error) {
      Q_EMIT document.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
    }
  });
}

}  // namespace footwall::ui
