#include <QApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QStandardPaths>
#include <memory>

#include "engine/tasks/new_project.h"
#include "storage/formats/stick_formats.h"
#include "ui/dialogs/export_choice.h"
#include "ui/window/action_groups.h"
#include "ui/window/banner.h"
#include "ui/window/dialogs.h"
#include "ui/window/main_window.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("Actions", text);
}

QString projects_folder() {
  return QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
}

void tell(MainWindow& window, const Error& error) {
  window.tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
}

void new_project(MainWindow& window) {
  const QString path = QFileDialog::getSaveFileName(&window, translated("New project"),
                                                    projects_folder() + QStringLiteral("/project.footwall"),
                                                    translated("Projects (*.footwall)"));
  if (path.isEmpty()) return;
  try {
    tasks::new_empty_project(path.toStdString());
  } catch (const Error& error) {
    return tell(window, error);
  }
  window.open_project(path);
}

void new_from_segy(MainWindow& window) {
  const QString path =
      QFileDialog::getOpenFileName(&window, translated("New from SEG-Y"), projects_folder(),
                                   translated("SEG-Y (*.sgy *.segy *.SGY *.SEGY);;All files (*)"));
  if (!path.isEmpty()) import_volume(window, path, true);
}

// In the user's documents, under the first name that is free.
void make_demo(MainWindow& window) {
  QDir folder(projects_folder());
  if (!folder.exists() && !folder.mkpath(QStringLiteral("."))) folder = QDir::home();
  QString path = folder.filePath(QStringLiteral("demo.footwall"));
  for (int n = 2; QFileInfo::exists(path); ++n)
    path = folder.filePath(QStringLiteral("demo-%1.footwall").arg(n));
  window.make_demo(path);
}

void open_project(MainWindow& window) {
  const QString path = QFileDialog::getOpenFileName(&window, translated("Open project"), projects_folder(),
                                                    translated("Projects (*.footwall);;All files (*)"));
  if (!path.isEmpty()) window.open_project(path);
}

void import_files(MainWindow& window) {
  for (const QString& path : QFileDialog::getOpenFileNames(&window, translated("Import")))
    window.take_file(path);
}

void export_sticks(MainWindow& window) {
  QStringList formats;
  for (const formats::StickFormat& format : formats::stick_formats()) {
    if (format.write == nullptr) continue;
    formats.append(QStringLiteral("%1 (*)").arg(
        QString::fromUtf8(format.title.data(), static_cast<qsizetype>(format.title.size()))));
  }
  QString chosen;
  const QString path =
      QFileDialog::getSaveFileName(&window, translated("Export fault sticks"), projects_folder(),
                                   formats.join(QStringLiteral(";;")), &chosen);
  if (path.isEmpty()) return;
  std::string name;
  for (const formats::StickFormat& format : formats::stick_formats()) {
    if (chosen == QStringLiteral("%1 (*)").arg(
                      QString::fromUtf8(format.title.data(), static_cast<qsizetype>(format.title.size())))) {
      name = format.name;
    }
  }
  ExportChoice choice;
  choice.kind = ExportChoice::Kind::kSticks;
  choice.file = path;
  choice.stick_format = name;
  Workbench& bench = *window.workbench();
  auto done = std::make_shared<Exported>();
  const QString file = QFileInfo(path).fileName();
  try {
    const auto write = prepare_export(bench.document.project(), choice, {});
    bench.jobs.start(
        translated("Export %1").arg(file), [write, done](const JobContext& job) { *done = write(job); },
        [&window, done, file] {
          window.banners().show_banner(QStringLiteral("export"),
                                       {.text = translated("%1: %2 written.").arg(file, done->text),
                                        .hint = done->notices.join(QStringLiteral("; ")),
                                        .passes = true});
        });
  } catch (const Error& error) {
    tell(window, error);
  }
}

void save_picture(MainWindow& window) {
  const QPixmap picture = window.grab();
  const QString path = QFileDialog::getSaveFileName(&window, translated("Save picture of the window"),
                                                    projects_folder() + QStringLiteral("/footwall.png"),
                                                    translated("PNG (*.png)"));
  if (path.isEmpty()) return;
  if (!picture.save(path, "PNG")) {
    window.tell_failure(translated("cannot write %1").arg(path),
                        translated("is the folder there, and not full?"));
  }
}

void save_scene(MainWindow& window) {
  const auto& write = window.views()->factories().write_picture;
  QWidget* scene = window.views()->scene()->view();
  if (!write) return;
  bool ok = false;
  const int width =
      QInputDialog::getInt(&window, translated("Save picture of the scene"), translated("Width in pixels:"),
                           2 * scene->width(), 64, 16384, 1, &ok);
  if (!ok) return;
  const QString path = QFileDialog::getSaveFileName(&window, translated("Save picture of the scene"),
                                                    projects_folder() + QStringLiteral("/scene.png"),
                                                    translated("PNG (*.png)"));
  if (path.isEmpty()) return;
  const QString problem = write(*scene, path, width);
  if (!problem.isEmpty()) window.tell_failure(problem, {});
}

}  // namespace

std::vector<ActionRow> file_actions() {
  using M = Menu;
  return {
      {"file.new", M::kFile, QT_TRANSLATE_NOOP("Actions", "&New project…"), "Ctrl+N", "new",
       QT_TRANSLATE_NOOP("Actions", "Make an empty project, without a survey yet"), kNothing, new_project},
      {"file.new-segy", M::kFile, QT_TRANSLATE_NOOP("Actions", "New from &SEG-Y…"), "Ctrl+Shift+N", "segy",
       QT_TRANSLATE_NOOP("Actions", "Make a project from a SEG-Y volume"), kNothing, new_from_segy},
      {"file.demo", M::kFile, QT_TRANSLATE_NOOP("Actions", "Synthetic &demo"), "Ctrl+Shift+D", "demo",
       QT_TRANSLATE_NOOP("Actions", "Make and open a project with a made-up survey and three faults"),
       kNothing, make_demo},
      {"file.open", M::kFile, QT_TRANSLATE_NOOP("Actions", "&Open project…"), "Ctrl+O", "open",
       QT_TRANSLATE_NOOP("Actions", "Open a project in the place of the one shown"), kNothing, open_project},
      {"file.import", M::kFile, QT_TRANSLATE_NOOP("Actions", "&Import…"), "Ctrl+I", "import",
       QT_TRANSLATE_NOOP("Actions",
                         "Bring volumes, fault sticks or surfaces into the project; the content tells which"),
       kProject | kWriting, import_files, nullptr, true},
      {"file.export-sticks", M::kFile, QT_TRANSLATE_NOOP("Actions", "&Export fault sticks…"), "Ctrl+E",
       "export", QT_TRANSLATE_NOOP("Actions", "Write all picked pillars as fault sticks"), kProject,
       export_sticks},
      {"file.export", M::kFile, QT_TRANSLATE_NOOP("Actions", "E&xport…"), "Ctrl+Shift+E", "export",
       QT_TRANSLATE_NOOP("Actions", "Write faces with their statistics, sticks, volumes or a picture"),
       kProject, open_export_dialog},
      {"file.picture", M::kFile, QT_TRANSLATE_NOOP("Actions", "Save &picture…"), "Ctrl+P", "picture",
       QT_TRANSLATE_NOOP("Actions", "Write a picture of the window as PNG"), kNothing, save_picture},
      {"file.scene-picture", M::kFile, QT_TRANSLATE_NOOP("Actions", "Save picture of the scene…"),
       "Ctrl+Shift+P", "picture",
       QT_TRANSLATE_NOOP("Actions", "Write a picture of the 3D scene as PNG, of any size"), kProject | kScene,
       save_scene},
      {"file.close", M::kFile, QT_TRANSLATE_NOOP("Actions", "&Close project"), "Ctrl+W", "close",
       QT_TRANSLATE_NOOP("Actions", "Close the project; everything is saved already"), kProject,
       [](MainWindow& window) { window.close_project(); }, nullptr, true},
      {"file.quit", M::kFile, QT_TRANSLATE_NOOP("Actions", "&Quit"), "Ctrl+Q", "quit",
       QT_TRANSLATE_NOOP("Actions", "Close the window; everything is saved already"), kNothing,
       [](MainWindow& window) { window.close(); }},
  };
}

}  // namespace footwall::ui
