#include "ui/window/saved_views.h"

#include <QCoreApplication>
#include <QInputDialog>
#include <QJsonDocument>
#include <algorithm>

#include "ui/model/project_tree.h"
#include "ui/window/main_window.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("SavedViews", text);
}

void tell(MainWindow& window, const Error& error) {
  window.tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
}

// Isosurfaces as the view has them; those that it does not know are hidden, those that are gone come back.
void take_over_isosurfaces(const Display& from, Workbench& bench) {
  Display& to = bench.display;
  std::vector<IsosurfaceLook> stored = from.isosurfaces();
  for (IsosurfaceLook look : std::vector<IsosurfaceLook>(to.isosurfaces())) {
    const auto same = std::ranges::find_if(stored, [&](const IsosurfaceLook& one) {
      return one.volume == look.volume && one.value == look.value;
    });
    look.visible = same != stored.end() && same->visible;
    if (same != stored.end()) {
      look.colour = same->colour;
      look.as_picture = same->as_picture;
      stored.erase(same);
    }
    to.change_isosurface(look);
  }
  const auto& volumes = bench.document.volumes();
  for (IsosurfaceLook look : stored) {
    if (std::ranges::find(volumes, look.volume, &project::VolumeRecord::id) == volumes.end()) continue;
    look.id = to.add_isosurface(look.volume, look.value);
    to.change_isosurface(look);
  }
}

// All but which sections there are: those stay where the user has them.
void take_over(const Display& from, Workbench& bench) {
  Display& to = bench.display;
  if (from.volume() != 0) to.set_volume(from.volume());
  to.set_samples(from.samples());
  to.set_faces(from.faces());
  for (const Fault& fault : bench.document.faults()) {
    const Item item{.kind = Item::Kind::kFault, .id = fault.record.id};
    to.set_visible(item, from.is_visible(item));
  }
  take_over_isosurfaces(from, bench);
  to.set_exaggeration(from.exaggeration());
  to.set_perspective(from.perspective());
}

}  // namespace

void save_view(MainWindow& window) {
  bool ok = false;
  const QString name = QInputDialog::getText(
      &window, translated("Save view"), translated("Name of the view (one of the same name is replaced):"),
      QLineEdit::Normal, {}, &ok);
  if (ok) save_view_as(window, name.trimmed());
}

bool save_view_as(MainWindow& window, const QString& name) {
  Workbench& bench = *window.workbench();
  const ViewTile* scene = window.views()->scene();
  if (scene == nullptr || !scene->is_built() || !window.views()->factories().camera) {
    window.tell_failure(translated("a view is one of the 3D scene, and there is none"),
                        translated("View > 3D scene opens it"));
    return false;
  }
  try {
    project::Project& project = bench.document.store();
    project.save_view({.name = name.toStdString(),
                       .camera = window.views()->factories().camera(*scene->view()).toStdString(),
                       .exaggeration = bench.display.exaggeration(),
                       .when = {}});
    const QByteArray shown = QJsonDocument(bench.display.to_json()).toJson(QJsonDocument::Compact);
    project.set_setting(setting_of_view(name), shown.toStdString());
  } catch (const Error& error) {
    tell(window, error);
    return false;
  }
  Q_EMIT bench.document.views_changed();
  return true;
}

void restore_view(MainWindow& window, const QString& name) {
  Workbench& bench = *window.workbench();
  try {
    const project::ViewRecord view = bench.document.project().view(name.toStdString());
    const auto shown = bench.document.project().setting(setting_of_view(name));
    if (shown) {
      Display stored(bench.document);
      stored.from_json(QJsonDocument::fromJson(QByteArray::fromStdString(*shown)).object());
      take_over(stored, bench);
    }
    if (view.exaggeration > 0) bench.display.set_exaggeration(view.exaggeration);
    window.views()->show_scene(true);
    const ViewTile* scene = window.views()->scene();
    const auto& set_camera = window.views()->factories().set_camera;
    if (!scene->is_built() || !set_camera) return;
    if (!set_camera(*scene->view(), QString::fromStdString(view.camera))) {
      window.tell_failure(translated("the camera of view %1 is not one that the scene understands").arg(name),
                          translated("footwall render draws it; save the view again here"));
    }
  } catch (const Error& error) {
    tell(window, error);
  }
}

}  // namespace footwall::ui
