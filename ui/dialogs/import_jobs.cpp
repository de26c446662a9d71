#include "ui/dialogs/import_jobs.h"

#include <utility>

#include "engine/tasks/new_project.h"
#include "engine/tasks/volume_sources.h"
#include "ui/model/project_job.h"

namespace footwall::ui {
namespace {

struct Import {
  std::unique_ptr<tasks::PlannedVolume> planned;
  Id listed = 0;
};

QString title_of(const std::filesystem::path& file) {
  return QObject::tr("Import %1").arg(QString::fromStdString(file.filename().string()));
}

}  // namespace

int import_segy(Workbench& workbench, const std::filesystem::path& file,
                const formats::segy::Options& options, const survey::Geometry& geometry,
                const std::string& name, std::function<void(Id)> done) {
  auto import = std::make_shared<Import>();
  import->planned = tasks::plan_volume(workbench.document.project(), name, geometry);
  const auto work = [import, file, options, geometry](project::Project& project, const JobContext& job) {
    const tasks::VolumeSource source = tasks::segy_source(file, options, job.part(0, 0.2)).source;
    if (source.geometry != geometry) {
      throw Error(ErrorCode::kInvalid, "the file has changed since its headers were shown",
                  "look at it again");
    }
    tasks::write_planned(*import->planned, source, job.part(0.2, 1));
    import->listed = tasks::list_planned(project, *import->planned, source).id;
  };
  return start_on_project(workbench, title_of(file), work, [&workbench, import, done = std::move(done)] {
    if (workbench.display.volume() == 0) workbench.display.set_volume(import->listed);
    if (done) done(import->listed);
  });
}

int import_segy_anew(Jobs& jobs, const std::filesystem::path& project, const std::filesystem::path& file,
                     const formats::segy::Options& options, const std::string& name,
                     std::function<void()> done) {
  const auto work = [project, file, options, name](const JobContext& job) {
    const tasks::SegyImport import = tasks::segy_source(file, options, job.part(0, 0.2));
    tasks::new_project(project, name, import.source, job.part(0.2, 1));
  };
  return jobs.start(title_of(file), work, std::move(done));
}

}  // namespace footwall::ui
