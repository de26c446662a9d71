#include "ui/model/project_job.h"

#include <map>
#include <memory>
#include <utility>

namespace footwall::ui {
namespace {

using Revisions = std::map<Id, std::int64_t>;

std::map<Id, Fault> read_changed(const project::Project& project, const Revisions& known) {
  std::map<Id, Fault> changed;
  for (project::FaultRecord& record : project.faults()) {
    const auto former = known.find(record.id);
    if (former != known.end() && former->second == record.revision) continue;
    const Id id = record.id;
    std::vector<survey::Pillar> pillars = project.pillars(id);
    changed[id] = {std::move(record), std::move(pillars)};
  }
  return changed;
}

}  // namespace

int start_on_project(Workbench& workbench, const QString& title, ProjectWork work, Jobs::Done done) {
  Document& document = workbench.document;
  Revisions known;
  for (const Fault& fault : document.faults()) known[fault.record.id] = fault.record.revision;
  auto project = std::make_shared<project::Project>(document.project().beside());
  // The workbench ends its jobs before its document, so that `document` is there as long as this runs.
  const auto take_up = [&document, known = std::move(known)](const project::Project& from) {
    auto changed = std::make_shared<std::map<Id, Fault>>(read_changed(from, known));
    QMetaObject::invokeMethod(
        &document, [&document, changed] { document.refresh(std::move(*changed)); }, Qt::QueuedConnection);
  };
  return workbench.jobs.start(
      title,
      [project, work = std::move(work), take_up](const JobContext& job) {
        try {
          work(*project, job);
        } catch (...) {
          take_up(*project);
          project->close();
          throw;
        }
        take_up(*project);
        project->close();
      },
      std::move(done));
}

}  // namespace footwall::ui
