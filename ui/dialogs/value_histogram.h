// How a volume's samples are spread, with a mark at the value of an isosurface that can be dragged.
#pragma once
#include <QWidget>

#include "storage/volume/volume_info.h"

namespace footwall::ui {

class ValueHistogram final : public QWidget {
  Q_OBJECT

 public:
  explicit ValueHistogram(QWidget* parent = nullptr);

  void show_histogram(const volume::Histogram& histogram);
  void clear();
  void set_value(double value);
  double value() const { return value_; }
  // Between position and value.
  double x_of(double value) const;

  QSize sizeHint() const override { return {360, 120}; }
  QSize minimumSizeHint() const override { return {160, 72}; }

 Q_SIGNALS:
  void value_moved(double value);  // by the mouse or the arrow keys

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void move_to(double value);

  volume::Histogram histogram_;
  bool known_ = false;
  double value_ = 0;
};

}  // namespace footwall::ui
