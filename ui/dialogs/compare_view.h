// Run A, run B and B - A over a fault's chart, side by side: axes in metres, colour bars, the values under
// the cursor.
#pragma once
#include <QWidget>
#include <memory>
#include <optional>

#include "ui/dialogs/compared_images.h"

namespace footwall::ui {

class CompareView final : public QWidget {
  Q_OBJECT

 public:
  explicit CompareView(QWidget* parent = nullptr);

  // Null: nothing yet.
  void show_compared(std::shared_ptr<const ComparedImages> compared);
  // Where a panel's raster is drawn, in pixels of the widget; empty where there is nothing.
  QRectF place_of_raster(std::size_t panel) const;
  // What is said of the cell there: its place in metres, A, B and their difference; empty outside.
  QString read_out(const QPointF& at) const;

  QSize sizeHint() const override { return {960, 360}; }

 Q_SIGNALS:
  void pointed(const QString& read_out);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  QRectF place_of_panel(std::size_t panel) const;
  double pixels_per_metre() const;
  void draw_panel(QPainter& painter, std::size_t panel) const;
  void draw_axes(QPainter& painter, const QRectF& raster, bool with_down) const;
  void draw_bar(QPainter& painter, const QRectF& bar, const ComparedImages::Panel& panel) const;

  std::shared_ptr<const ComparedImages> compared_;
};

}  // namespace footwall::ui
