// One section of the survey with everything that is picked on it: samples, axes, faults, pillars; a slider
// steps it.
#pragma once
#include <QJsonObject>
#include <QSlider>
#include <QWidget>

#include "ui/model/workbench.h"
#include "ui/section/section_canvas.h"

namespace footwall::ui {

class SectionView final : public QWidget {
  Q_OBJECT

 public:
  // section_of_display: a ShownSection::id. When the display drops it, the view says so and shows nothing.
  SectionView(Workbench& bench, Id section_of_display, QWidget* parent = nullptr);

  SectionCanvas& canvas() { return *canvas_; }
  Id shown() const { return shown_; }
  // What of the section is shown; empty: all of it.
  QJsonObject look() const;
  // Takes what it understands.
  void set_look(const QJsonObject& look);
  // For the title's right side: "amplitude".
  QString details() const;

 Q_SIGNALS:
  void details_changed();
  // An empty view's button.
  void import_wanted();

 private:
  void follow_display();

  Workbench& bench_;
  Id shown_;
  SectionCanvas* canvas_ = nullptr;
  QSlider* slider_ = nullptr;
};

}  // namespace footwall::ui
