#include "ui/window/dialogs.h"

#include <QFileInfo>

#include "storage/base/error.h"
#include "storage/formats/segy/segy_file.h"
#include "ui/dialogs/compare_dialog.h"
#include "ui/dialogs/export_dialog.h"
#include "ui/dialogs/import_segy_dialog.h"
#include "ui/dialogs/isosurface_dialog.h"
#include "ui/dialogs/run_dialog.h"
#include "ui/dialogs/transform_dialog.h"
#include "ui/dialogs/trim_history_dialog.h"
#include "ui/window/banner.h"
#include "ui/window/main_window.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"
#include "ui/window/views.h"

namespace footwall::ui {
namespace {

void show(QDialog* dialog) {
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::WindowModal);
  dialog->show();
}

}  // namespace

void import_volume(MainWindow& window, const QString& path, bool anew) {
  if (!formats::segy::looks_like_segy(path.toStdString())) {
    window.tell_failure(window.tr("%1 is no SEG-Y file, and the import dialog takes no other volumes yet")
                            .arg(QFileInfo(path).fileName()),
                        window.tr("footwall new, or footwall import volume, takes it on the command line"));
    return;
  }
  Workbench* workbench = anew ? nullptr : window.workbench();
  if (workbench != nullptr && workbench->document.read_only()) {
    window.tell_failure(window.tr("somebody else writes this project: nothing can be imported"), {});
    return;
  }
  auto* dialog = new ImportSegyDialog(path, workbench, &window);
  QObject::connect(
      dialog, &ImportSegyDialog::project_made, &window,
      [&window](const QString& project) { window.open_project(project); }, Qt::QueuedConnection);
  show(dialog);
}

void open_run_dialog(MainWindow& window) {
  show(new RunDialog(*window.workbench(), &window));
}

void open_export_dialog(MainWindow& window) {
  WritePicture write;
  const auto& write_scene = window.views()->factories().write_picture;
  if (write_scene && window.views()->scene() != nullptr) {
    write = [&window](const QString& file) {
      QWidget* scene = window.views()->scene()->view();
      const QString problem = window.views()->factories().write_picture(*scene, file, 2 * scene->width());
      if (!problem.isEmpty()) throw Error(ErrorCode::kIo, problem.toStdString());
    };
  }
  show(new ExportDialog(*window.workbench(), std::move(write), &window));
}

void open_transform_dialog(MainWindow& window) {
  const Workbench& bench = *window.workbench();
  const Selection& selection = bench.selection;
  const auto moved =
      transformed(bench.document, selection.faults(), selection.pillars(), selection.nodes(), {});
  if (moved.empty()) {
    return window.tell_failure(window.tr("nothing is selected that has nodes"),
                               window.tr("select nodes, pillars or faults first"));
  }
  for (const auto& [node, place] : moved) {
    const Fault* fault = bench.document.fault_of_node(node);
    if (!fault->record.locked) continue;
    return window.tell_failure(window.tr("%1 is locked").arg(QString::fromStdString(fault->record.name)),
                               window.tr("unlock it first"));
  }
  show(new TransformDialog(*window.workbench(), &window));
}

void open_compare_dialog(MainWindow& window) {
  show(new CompareDialog(*window.workbench(), &window));
}

void open_trim_history_dialog(MainWindow& window) {
  window.banners().remove(QStringLiteral("history"));
  show(new TrimHistoryDialog(*window.workbench(), &window));
}

void warn_of_history(MainWindow& window) {
  constexpr std::int64_t kLarge = std::int64_t{256} << 20;
  const project::Project& project = window.workbench()->document.project();
  if (project.read_only()) return;
  const std::int64_t bytes = project.history_size().bytes;
  const auto days = history_keep_days(project);
  const std::int64_t old = days ? project.history_size(days_ago(*days)).steps : 0;
  QString text;
  if (bytes > kLarge) text = window.tr("The history takes %1 MiB of the project.").arg(bytes >> 20);
  if (old > 0) text = window.tr("%1 steps of the history are older than %2 days.").arg(old).arg(*days);
  if (text.isEmpty()) return;
  window.banners().show_banner(
      QStringLiteral("history"),
      {.kind = BannerArea::Kind::kNotice,
       .text = text,
       .hint = window.tr("nothing is dropped by itself"),
       .buttons = {
           {window.tr("Trim…"), [&window] { open_trim_history_dialog(window); }},
           {window.tr("Keep all"), [&window] { window.banners().remove(QStringLiteral("history")); }}}});
}

void open_isosurface_dialog(MainWindow& window, Id isosurface) {
  auto* dialog = new IsosurfaceDialog(*window.workbench(), isosurface, &window);
  dialog->adjustSize();
  // At the right: the scene, which follows its slider, stays in sight.
  constexpr int kMargin = 24;
  dialog->move(window.mapToGlobal(
      QPoint(window.width() - dialog->width() - kMargin, (window.height() - dialog->height()) / 2)));
  show(dialog);
}

}  // namespace footwall::ui
