#include "ui/panels/histogram.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace footwall::ui {
namespace {

constexpr int kBins = 24;
constexpr int kLabelHeight = 18;
constexpr int kMargin = 4;
constexpr double kKeyStep = 1.0 / 50;

}  // namespace

std::vector<int> bins_of(const std::vector<double>& values, double low, double high, int count) {
  std::vector<int> bins(static_cast<std::size_t>(count), 0);
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    const double place = high > low ? (value - low) / (high - low) * count : 0;
    ++bins[static_cast<std::size_t>(std::clamp(place, 0.0, count - 1.0))];
  }
  return bins;
}

Histogram::Histogram(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::TabFocus);
  setToolTip(tr("Drag the handles to choose the range of colours; a double-click chooses it from the data"));
}

void Histogram::show_values(const std::vector<double>& values,
                            std::optional<std::pair<double, double>> range) {
  double from = INFINITY, to = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    from = std::min(from, value);
    to = std::max(to, value);
  }
  if (from > to) {
    bins_.clear();
  } else {
    from_ = from;
    to_ = to > from ? to : from + 1;
    const std::vector<int> counts = bins_of(values, from_, to_, kBins);
    bins_.assign(counts.begin(), counts.end());
  }
  if (!dragging_) {
    low_ = range ? range->first : from_;
    high_ = range ? range->second : to_;
  }
  update();
}

void Histogram::show_bars(std::vector<double> heights, double from, double to,
                          std::pair<double, double> range) {
  from_ = from;
  to_ = to > from ? to : from + 1;
  bins_ = std::move(heights);
  if (!dragging_) std::tie(low_, high_) = range;
  update();
}

void Histogram::set_range(double low, double high) {
  low_ = low;
  high_ = high;
  update();
}

double Histogram::x_of(double value) const {
  return kMargin + (std::clamp(value, from_, to_) - from_) / (to_ - from_) * (width() - 2 * kMargin);
}

double Histogram::value_at(double x) const {
  const double part = (x - kMargin) / std::max(1, width() - 2 * kMargin);
  return from_ + std::clamp(part, 0.0, 1.0) * (to_ - from_);
}

void Histogram::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setPen(palette().color(QPalette::PlaceholderText));
  if (bins_.empty()) {
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, tr("no values yet"));
    return;
  }
  const int bottom = height() - kLabelHeight;
  const double most = *std::ranges::max_element(bins_);
  const auto count = static_cast<int>(bins_.size());
  const double step = static_cast<double>(width() - 2 * kMargin) / count;
  const QColor inside = palette().color(QPalette::Highlight);
  for (int n = 0; n < count; ++n) {
    const double centre = from_ + (n + 0.5) * (to_ - from_) / count;
    const double tall = most > 0 ? bins_[static_cast<std::size_t>(n)] / most * (bottom - 4) : 0;
    painter.fillRect(QRectF(kMargin + n * step, bottom - tall, std::max(1.0, step - 1.5), tall),
                     centre >= low_ && centre <= high_ ? inside : palette().color(QPalette::Mid));
  }
  painter.setRenderHint(QPainter::Antialiasing);
  for (int handle = 0; handle < 2; ++handle) {
    const double x = x_of(handle == 0 ? low_ : high_);
    painter.setPen(QPen(palette().color(QPalette::Text), hasFocus() && handle == handle_ ? 2 : 1));
    painter.drawLine(QPointF(x, 2), QPointF(x, bottom));
    painter.setBrush(palette().color(QPalette::Text));
    painter.drawPolygon(QPolygonF{{x - 4, 0}, {x + 4, 0}, {x, 5}});
  }
  painter.setPen(palette().color(QPalette::PlaceholderText));
  const QRect labels(kMargin, bottom + 2, width() - 2 * kMargin, kLabelHeight - 2);
  painter.drawText(labels, Qt::AlignLeft, QString::number(from_, 'g', 3));
  painter.drawText(labels, Qt::AlignRight, QString::number(to_, 'g', 3));
  painter.drawText(labels, Qt::AlignHCenter,
                   QStringLiteral("%1 – %2").arg(low_, 0, 'g', 3).arg(high_, 0, 'g', 3));
}

void Histogram::move_handle(double value) {
  if (handle_ == 0) {
    low_ = std::min(value, high_);
  } else {
    high_ = std::max(value, low_);
  }
  update();
  Q_EMIT range_changed(low_, high_);
}

void Histogram::mousePressEvent(QMouseEvent* event) {
  if (bins_.empty() || event->button() != Qt::LeftButton) return;
  const double x = event->position().x();
  handle_ = std::abs(x - x_of(low_)) <= std::abs(x - x_of(high_)) ? 0 : 1;
  dragging_ = true;
  setFocus(Qt::MouseFocusReason);
}

void Histogram::mouseMoveEvent(QMouseEvent* event) {
  if (dragging_) move_handle(value_at(event->position().x()));
}

void Histogram::mouseReleaseEvent(QMouseEvent*) {
  dragging_ = false;
}

void Histogram::mouseDoubleClickEvent(QMouseEvent*) {
  dragging_ = false;
  Q_EMIT range_reset();
}

// Left and right move a handle, up and down choose it.
void Histogram::keyPressEvent(QKeyEvent* event) {
  const double step = (to_ - from_) * kKeyStep;
  const double now = handle_ == 0 ? low_ : high_;
  switch (event->key()) {
    case Qt::Key_Left:
      return move_handle(now - step);
    case Qt::Key_Right:
      return move_handle(now + step);
    case Qt::Key_Up:
    case Qt::Key_Down:
      handle_ = 1 - handle_;
      return update();
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace footwall::ui
