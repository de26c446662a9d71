#include "ui/window/import_files.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <memory>

#include "engine/tasks/import_sticks.h"
#include "engine/tasks/import_surface.h"
#include "ui/model/project_job.h"
#include "ui/window/banner.h"
#include "ui/window/file_kinds.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("ImportFiles", text);
}

struct Told {
  QString text;
  std::vector<std::string> notices;
};

Told read_sticks(project::Project& project, const QString& path, const JobContext& job) {
  const tasks::SticksImported done = tasks::import_sticks(project, path.toStdString(), {}, {}, job);
  return {translated("%1: %2 pillars of %3 faults (%4), %5 rows skipped, %6 rejected.")
              .arg(QFileInfo(path).fileName())
              .arg(done.pillars)
              .arg(done.faults.size())
              .arg(QString::fromStdString(done.format))
              .arg(done.report.skipped)
              .arg(done.report.rejected_count),
          done.notices};
}

Told read_surface(project::Project& project, const QString& path, const JobContext& job) {
  const tasks::SurfacesImported done = tasks::import_surface(project, path.toStdString(), {}, job);
  std::int64_t triangles = 0;
  for (const tasks::ImportedSurface& one : done.faults) triangles += one.triangles;
  return {translated("%1: %2 faults of %3 triangles, %4 rows rejected.")
              .arg(QFileInfo(path).fileName())
              .arg(done.faults.size())
              .arg(triangles)
              .arg(done.report.rejected_count),
          done.notices};
}

}  // namespace

void import_interpretation(MainWindow& window, const QString& path) {
  Workbench* bench = window.workbench();
  const QString name = QFileInfo(path).fileName();
  if (bench == nullptr || bench->document.read_only()) {
    window.tell_failure(translated("%1 needs a project to go into").arg(name),
                        translated("open one for writing, or make one, first"));
    return;
  }
  const bool surface = kind_of_file(path) == FileKind::kSurface;
  auto told = std::make_shared<Told>();
  try {
    start_on_project(
        *bench, translated("Import %1").arg(name),
        [told, path, surface](project::Project& project, const JobContext& job) {
          *told = surface ? read_surface(project, path, job) : read_sticks(project, path, job);
        },
        [&window, told] {
          QStringList notices;
          for (const std::string& notice : told->notices) notices.append(QString::fromStdString(notice));
          window.banners().show_banner(QStringLiteral("import"), {.kind = BannerArea::Kind::kNotice,
                                                                  .text = told->text,
                                                                  .hint = notices.join(QStringLiteral("; ")),
                                                                  .passes = true});
        });
  } catch (const Error& error) {
    window.tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  }
}

}  // namespace footwall::ui
