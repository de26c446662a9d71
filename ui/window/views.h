// What the tiles of the window hold: each kind of view is made by a function, so that the window knows no
// view by name.
#pragma once
#include <QJsonObject>
#include <functional>

#include "ui/model/workbench.h"

class QWidget;

namespace footwall::ui {

struct ViewFactories {
  std::function<QWidget*(Workbench& workbench, Id section, QWidget* parent)>
      section;  // of a section of Display
  std::function<QWidget*(Workbench& workbench, QWidget* parent)> scene;

  // What of a section is shown (zoom, place, stretch), as the window's layout keeps it; each takes the widget
  // that `section` made.
  std::function<QJsonObject(const QWidget& section)> section_look;
  std::function<void(QWidget& section, const QJsonObject& look)> set_section_look;

  // What a scene can do beside; each takes the widget that `scene` made.
  std::function<QString(const QWidget& scene)> camera;  // as views keep it; empty before it was shown
  std::function<bool(QWidget& scene, const QString& camera)> set_camera;
  enum class From { kTop, kNorth, kEast, kSouth, kWest, kOblique };
  std::function<void(QWidget& scene, From side)> look_from;
  // Writes a PNG this wide, in the proportions of the view. Returns why that failed; empty: it did not.
  std::function<QString(QWidget& scene, const QString& path, int width)> write_picture;
  std::function<bool(const QWidget& scene)> is_settled;
};

// Those that this program has; a kind that it has not shows a label that says so.
ViewFactories built_views();

}  // namespace footwall::ui
