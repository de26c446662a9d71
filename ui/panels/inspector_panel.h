// What is selected: its properties, the spread of the shown statistic or of a volume's values, how fine its
// triangles are, and what can be done.
#pragma once
#include <QScrollArea>
#include <functional>
#include <set>

#include "ui/model/workbench.h"
#include "ui/panels/project_panel.h"
#include "ui/panels/properties.h"

class QFormLayout;
class QLabel;
class QSlider;
class QTimer;

namespace footwall::ui {

class FaultFields;
class Histogram;
class VolumeBox;

class InspectorPanel final : public QScrollArea {
  Q_OBJECT

 public:
  InspectorPanel(Workbench& workbench, FindAction action, QWidget* parent = nullptr);

  const Properties& shown() const { return shown_; }
  Histogram& histogram() { return *histogram_; }
  FaultFields& fields() { return *fields_; }
  VolumeBox& volume() { return *volume_; }

 private:
  void refresh();
  void show_rows();
  void refresh_statistic();
  void refresh_detail();
  void set_detail();
  Id shown_fault() const;
  void soon();

  Workbench& workbench_;
  Properties shown_;
  QWidget* body_ = nullptr;
  QLabel* title_ = nullptr;
  QWidget* rows_ = nullptr;
  FaultFields* fields_ = nullptr;
  VolumeBox* volume_ = nullptr;
  QWidget* of_fault_ = nullptr;
  QLabel* statistic_ = nullptr;
  Histogram* histogram_ = nullptr;
  QLabel* detail_text_ = nullptr;
  QSlider* detail_ = nullptr;
  QTimer* timer_ = nullptr;
};

}  // namespace footwall::ui
