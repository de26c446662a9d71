// The bins of a SEG-Y file from above: live traces, holes, duplicates. A click chooses the line to preview.
#pragma once
#include <QImage>
#include <QWidget>
#include <memory>

#include "ui/dialogs/segy_looker.h"

namespace footwall::ui {

class SegyMapView final : public QWidget {
  Q_OBJECT

 public:
  explicit SegyMapView(QWidget* parent = nullptr);

  // Null: nothing is known.
  void show_look(std::shared_ptr<const SegyLook> look);
  // Where the map is drawn, crosslines to the right, inlines up.
  QRectF map_rect() const;
  static QColor colour_of(formats::segy::Bin bin, const QPalette& palette);
  // Of a bin, by its indices.
  QPointF position_of(std::int64_t inline_index, std::int64_t crossline_index) const;

  QSize sizeHint() const override { return {300, 320}; }
  QSize minimumSizeHint() const override { return {160, 160}; }

 Q_SIGNALS:
  void bin_chosen(qint64 inline_index, qint64 crossline_index);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void make_image();
  void choose_at(const QPointF& position);

  std::shared_ptr<const SegyLook> look_;
  QImage image_;
};

}  // namespace footwall::ui
