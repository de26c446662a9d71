// An isosurface of a volume, new or shown already: its value over the volume's histogram. What is shown
// follows at once; Cancel puts back what was.
#pragma once
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <optional>

#include "ui/dialogs/value_histogram.h"
#include "ui/model/volume_looker.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

class IsosurfaceDialog final : public QDialog {
  Q_OBJECT

 public:
  // isosurface: of Display; 0: a new one of the volume shown, made as soon as its histogram is known.
  IsosurfaceDialog(Workbench& workbench, Id isosurface, QWidget* parent = nullptr);

  // The one that is shown; 0 until it is made.
  Id isosurface() const { return isosurface_; }

 public Q_SLOTS:
  void reject() override;

 private:
  const IsosurfaceLook* look() const;
  void read_histogram();
  void histogram_read(const volume::Statistics& statistics);
  void set_value(double value);
  void choose_colour();
  void set_as_picture(bool as_picture);
  void show_colour();

  Workbench& workbench_;
  Id isosurface_;
  std::optional<IsosurfaceLook> before_;
  VolumeLooker looker_;
  QComboBox *volume_, *shown_as_;
  ValueHistogram* histogram_;
  QDoubleSpinBox* value_;
  QPushButton *colour_, *ok_;
  QLabel* message_;
};

}  // namespace footwall::ui
