// Work on the open project that takes its time, as a job: it gets a connection of its own to the project, on
// a thread of its own, and the document takes up what it changed.
#pragma once
#include <QString>
#include <functional>

#include "ui/model/workbench.h"

namespace footwall::ui {

using ProjectWork = std::function<void(project::Project&, const JobContext&)>;

// work edits the project as the document would, one transaction an edit: a gesture made while one is being
// stored waits for it. Where work fails or is cancelled, what it had stored before stays. Before `done`
// (which runs in the window's thread where all went well), the document has been refreshed: the pillars that
// differ were read on the job's thread. Returns the job's number. Throws what Project::beside() throws; later
// failures come as Jobs::finished.
int start_on_project(Workbench& workbench, const QString& title, ProjectWork work, Jobs::Done done = {});

}  // namespace footwall::ui
