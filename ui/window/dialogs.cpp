#include "ui/window/dialogs.h"

#include <QFileInfo>

#include "storage/base/error.h"
#include "storage/formats/segy/segy_file.h"
#include "ui/dialogs/export_dialog.h"
#include "ui/dialogs/import_segy_dialog.h"
#include "ui/dialogs/isosurface_dialog.h"
#include "ui/dialogs/run_dialog.h"
#include "ui/dialogs/transform_dialog.h"
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
  QObject::connect(dialog, &ImportSegyDialog::project_made, &window,
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
