#include "ui/dialogs/value_histogram.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <vector>

#include "ui/model/volume_spread.h"

namespace footwall::ui {
namespace {

constexpr int kFoot = 20;  // room for the numbers

}  // namespace

ValueHistogram::ValueHistogram(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::SizeHorCursor);
  setAccessibleName(tr("Histogram of the volume and the value"));
}

void ValueHistogram::show_histogram(const volume::Histogram& histogram) {
  histogram_ = histogram;
  known_ = histogram.hi > histogram.lo;
  update();
}

void ValueHistogram::clear() {
  known_ = false;
  update();
}

void ValueHistogram::set_value(double value) {
  value_ = value;
  update();
}

double ValueHistogram::x_of(double value) const {
  return known_ ? (value - histogram_.lo) / (histogram_.hi - histogram_.lo) * width() : 0;
}

void ValueHistogram::move_to(double value) {
  if (!known_) return;
  set_value(std::clamp(value, histogram_.lo, histogram_.hi));
  Q_EMIT value_moved(value_);
}

void ValueHistogram::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const int foot = height() - kFoot;
  painter.setPen(palette().color(QPalette::PlaceholderText));
  if (!known_) {
    painter.drawText(rect(), Qt::AlignCenter, tr("reading the histogram …"));
    return;
  }
  const int bars = std::clamp(width() / 6, 8, 64);
  const std::vector<double> heights = bar_heights(histogram_, bars);
  const double each = static_cast<double>(width()) / bars;
  const QColor accent = palette().color(QPalette::Highlight);
  for (int n = 0; n < bars; ++n) {
    const double high = heights[static_cast<std::size_t>(n)] * (foot - 4);
    painter.fillRect(QRectF(n * each + 0.5, foot - high, std::max(1.0, each - 1), high), accent.darker(130));
  }
  const auto number = [](double value) { return QString::number(value, 'g', 3); };
  painter.drawText(QRect(0, foot, width(), kFoot), Qt::AlignLeft | Qt::AlignBottom, number(histogram_.lo));
  painter.drawText(QRect(0, foot, width(), kFoot), Qt::AlignRight | Qt::AlignBottom, number(histogram_.hi));
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(palette().color(QPalette::Text), 2));
  const double x = std::clamp(x_of(value_), 1.0, width() - 1.0);
  painter.drawLine(QPointF(x, 0), QPointF(x, foot));
  if (hasFocus()) {
    painter.setBrush(palette().color(QPalette::Text));
    painter.drawEllipse(QPointF(x, 4), 3, 3);
  }
}

void ValueHistogram::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) mouseMoveEvent(event);
}

void ValueHistogram::mouseMoveEvent(QMouseEvent* event) {
  move_to(histogram_.lo + event->position().x() / std::max(1, width()) * (histogram_.hi - histogram_.lo));
}

void ValueHistogram::keyPressEvent(QKeyEvent* event) {
  const double step = (histogram_.hi - histogram_.lo) / 100;
  if (event->key() == Qt::Key_Left) return move_to(value_ - step);
  if (event->key() == Qt::Key_Right) return move_to(value_ + step);
  QWidget::keyPressEvent(event);
}

}  // namespace footwall::ui
