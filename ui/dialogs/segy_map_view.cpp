#include "ui/dialogs/segy_map_view.h"

#include <QEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

namespace footwall::ui {
namespace {

namespace segy = formats::segy;

constexpr int kMargin = 44;
constexpr int kGap = 4;

// Width by height of the survey on the ground; by its bins where there is no map.
double aspect_of(const segy::Inspection& found) {
  double bin_aspect = 1;
  if (found.geometry) {
    const survey::MapView& map = found.geometry->map;
    const double across = std::hypot(map.per_crossline_x, map.per_crossline_y);
    const double along = std::hypot(map.per_inline_x, map.per_inline_y);
    if (across > 0 && along > 0) bin_aspect = across / along;
  }
  const double aspect =
      bin_aspect * static_cast<double>(found.crosslines->count) / static_cast<double>(found.inlines->count);
  return std::clamp(aspect, 1.0 / 12, 12.0);
}

std::int64_t index_at(double share, std::int64_t count) {
  const double n = static_cast<double>(count);
  return std::clamp(static_cast<std::int64_t>(std::floor(share * n)), std::int64_t{0}, count - 1);
}

}  // namespace

QColor SegyMapView::colour_of(segy::Bin bin, const QPalette& palette) {
  const QColor base = palette.color(QPalette::Base);
  const QColor accent = palette.color(QPalette::Highlight);
  switch (bin) {
    case segy::Bin::kLive:  // the accent, quieter: the map is mostly of it
      return QColor((base.red() + accent.red()) / 2, (base.green() + accent.green()) / 2,
                    (base.blue() + accent.blue()) / 2);
    case segy::Bin::kDuplicate:
      return palette.color(QPalette::BrightText);
    case segy::Bin::kHole:
      break;
  }
  return palette.color(QPalette::Window);
}

SegyMapView::SegyMapView(QWidget* parent) : QWidget(parent) {
  setCursor(Qt::CrossCursor);
  setAccessibleName(tr("Survey map"));
}

void SegyMapView::show_look(std::shared_ptr<const SegyLook> look) {
  const bool same = look && look_ && look->survey == look_->survey;
  look_ = std::move(look);
  if (!same) make_image();
  update();
}

void SegyMapView::make_image() {
  image_ = {};
  if (!look_ || look_->survey->map().rows == 0) return;
  const segy::TraceMap& map = look_->survey->map();
  image_ = QImage(static_cast<int>(map.columns), static_cast<int>(map.rows), QImage::Format_RGB32);
  std::array<QRgb, 3> colours{};
  for (const segy::Bin bin : {segy::Bin::kHole, segy::Bin::kLive, segy::Bin::kDuplicate}) {
    colours[static_cast<std::size_t>(bin)] = colour_of(bin, palette()).rgb();
  }
  for (int row = 0; row < image_.height(); ++row) {
    auto* line = reinterpret_cast<QRgb*>(image_.scanLine(image_.height() - 1 - row));
    for (int column = 0; column < image_.width(); ++column)
      line[column] = colours[static_cast<std::size_t>(map.at(row, column))];
  }
}

QRectF SegyMapView::map_rect() const {
  if (image_.isNull()) return {};
  const QRectF room = QRectF(rect()).adjusted(kMargin, kGap, -kGap, -24);
  const double aspect = aspect_of(look_->survey->found());
  const QSizeF size = QSizeF(aspect, 1).scaled(room.size(), Qt::KeepAspectRatio);
  return {QPointF(room.left() + (room.width() - size.width()) / 2,
                  room.top() + (room.height() - size.height()) / 2),
          size};
}

QPointF SegyMapView::position_of(std::int64_t inline_index, std::int64_t crossline_index) const {
  const QRectF area = map_rect();
  const segy::Inspection& found = look_->survey->found();
  return {area.left() + area.width() * (static_cast<double>(crossline_index) + 0.5) /
                            static_cast<double>(found.crosslines->count),
          area.bottom() - area.height() * (static_cast<double>(inline_index) + 0.5) /
                              static_cast<double>(found.inlines->count)};
}

void SegyMapView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  painter.setPen(palette().color(QPalette::PlaceholderText));
  if (image_.isNull()) {
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     look_ ? tr("the line numbers make no map") : tr("reading the headers …"));
    return;
  }
  const QRectF area = map_rect();
  painter.setRenderHint(QPainter::SmoothPixmapTransform, image_.width() > area.width());
  painter.drawImage(area, image_);
  const segy::Inspection& found = look_->survey->found();
  const QFontMetricsF metrics(font());
  const auto left_label = [&](double y, std::int64_t line) {
    painter.drawText(QRectF(0, y - metrics.height() / 2, area.left() - kGap, metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter, QString::number(line));
  };
  left_label(area.top() + metrics.height() / 2, found.inlines->last());
  left_label(area.bottom() - metrics.height() / 2, found.inlines->first);
  painter.drawText(QRectF(area.left(), area.bottom() + 2, area.width(), metrics.height()), Qt::AlignLeft,
                   QString::number(found.crosslines->first));
  if (found.crosslines->count > 1) {
    painter.drawText(QRectF(area.left(), area.bottom() + 2, area.width(), metrics.height()), Qt::AlignRight,
                     QString::number(found.crosslines->last()));
  }
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(area);

  // The line of the preview.
  const segy::LinePreview& line = look_->line;
  if (line.traces == 0) return;
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(palette().color(QPalette::Text), 1.5));
  if (line.of_inline) {
    const double y = position_of(found.inlines->index_of(line.line), 0).y();
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
  } else {
    const double x = position_of(0, found.crosslines->index_of(line.line)).x();
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
  }
}

void SegyMapView::choose_at(const QPointF& position) {
  const QRectF area = map_rect();
  if (area.isEmpty()) return;
  const segy::Inspection& found = look_->survey->found();
  Q_EMIT bin_chosen(index_at((area.bottom() - position.y()) / area.height(), found.inlines->count),
                    index_at((position.x() - area.left()) / area.width(), found.crosslines->count));
}

void SegyMapView::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && map_rect().contains(event->position()))
    choose_at(event->position());
}

void SegyMapView::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons().testFlag(Qt::LeftButton)) choose_at(event->position());
}

void SegyMapView::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) make_image();
  QWidget::changeEvent(event);
}

}  // namespace footwall::ui
