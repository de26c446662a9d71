#include "ui/dialogs/compare_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

namespace footwall::ui {
namespace {

constexpr double kTitle = 22, kTicks = 34, kBar = 34, kDown = 62, kGap = 16;  // pixels
constexpr double kTickSpacing = 56, kDownSpacing = 24;

// 1, 2 or 5 x 10^n, not below.
double round_step(double at_least) {
  const double power = std::pow(10.0, std::floor(std::log10(at_least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= at_least) return factor * power;
  }
  return 10 * power;
}

QString number(double value) {
  return std::isfinite(value) ? QString::number(value, 'g', 5) : QStringLiteral("–");
}

QString metres(double value) {
  return QString::number(value, 'f', 0);
}

}  // namespace

CompareView::CompareView(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setMinimumSize(480, 220);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void CompareView::show_compared(std::shared_ptr<const ComparedImages> compared) {
  compared_ = std::move(compared);
  Q_EMIT pointed(QString());
  update();
}

QRectF CompareView::place_of_panel(std::size_t panel) const {
  const double width = (this->width() - kDown - 2 * kGap) / 3.0;
  return {kDown + static_cast<double>(panel) * (width + kGap), 0, width, static_cast<double>(height())};
}

// One scale for both axes: faults keep their shape.
double CompareView::pixels_per_metre() const {
  const tasks::RunComparison& made = compared_->comparison;
  const tasks::CellPlace far = tasks::place_of(made, made.raster.columns, made.raster.rows);
  const QRectF panel = place_of_panel(0);
  const double high = panel.height() - kTitle - kTicks - kBar;
  return std::max(0.0, std::min(panel.width() / far.along, high / far.down));
}

QRectF CompareView::place_of_raster(std::size_t panel) const {
  if (!compared_ || compared_->comparison.raster.cells() == 0) return {};
  const tasks::RunComparison& made = compared_->comparison;
  const tasks::CellPlace far = tasks::place_of(made, made.raster.columns, made.raster.rows);
  const double scale = pixels_per_metre();
  return {place_of_panel(panel).left(), kTitle, far.along * scale, far.down * scale};
}

QString CompareView::read_out(const QPointF& at) const {
  for (std::size_t n = 0; n < 3; ++n) {
    const QRectF place = place_of_raster(n);
    if (!place.contains(at) || place.isEmpty()) continue;
    const tasks::RunComparison& made = compared_->comparison;
    const auto part = [](double where, double from, double length, std::int64_t count) {
      const auto cell = static_cast<std::int64_t>((where - from) / length * static_cast<double>(count));
      return std::clamp<std::int64_t>(cell, 0, count - 1);
    };
    const std::int64_t column = part(at.x(), place.left(), place.width(), made.raster.columns);
    const std::int64_t row = part(at.y(), place.top(), place.height(), made.raster.rows);
    const auto cell = static_cast<std::size_t>(row * made.raster.columns + column);
    const tasks::CellPlace where = tasks::place_of(made, column, row);
    return tr("along %1 m, down %2 m:  A %3   B %4   B − A %5 %6")
        .arg(metres(where.along), metres(where.down), number(made.a[cell]), number(made.b[cell]),
             number(made.difference[cell]), QString::fromStdString(made.unit));
  }
  return {};
}

void CompareView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  if (!compared_ || compared_->comparison.raster.cells() == 0) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect(), Qt::AlignCenter, tr("Choose two runs, and press Compare"));
    return;
  }
  for (std::size_t n = 0; n < 3; ++n) draw_panel(painter, n);
}

void CompareView::draw_panel(QPainter& painter, std::size_t n) const {
  const tasks::RunComparison& made = compared_->comparison;
  const QRectF panel = place_of_panel(n);
  const QRectF raster = place_of_raster(n);
  const QString a = tr("A: %1").arg(QString::fromStdString(made.run_a.name));
  const QString b = tr("B: %1").arg(QString::fromStdString(made.run_b.name));
  const QString title = n == 0 ? a : n == 1 ? b : tr("B − A");
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(QRectF(panel.left(), 0, panel.width(), kTitle), Qt::AlignLeft | Qt::AlignVCenter,
                   painter.fontMetrics().elidedText(title, Qt::ElideMiddle, static_cast<int>(panel.width())));
  painter.fillRect(raster, palette().color(QPalette::Window));
  painter.drawImage(raster, compared_->panels[n].image);
  draw_axes(painter, raster, n == 0);
  draw_bar(painter, {panel.left(), raster.bottom() + kTicks, panel.width(), kBar}, compared_->panels[n]);
}

void CompareView::draw_axes(QPainter& painter, const QRectF& raster, bool with_down) const {
  const double scale = pixels_per_metre();
  if (!(scale > 0)) return;
  const double step = round_step(kTickSpacing / scale);
  painter.setPen(palette().color(QPalette::PlaceholderText));
  painter.drawRect(raster.adjusted(0, 0, -1, -1));
  for (double at = 0; at * scale < raster.width(); at += step) {
    const double x = raster.left() + at * scale;
    painter.drawLine(QPointF(x, raster.bottom()), QPointF(x, raster.bottom() + 4));
    painter.drawText(QRectF(x - kTickSpacing / 2, raster.bottom() + 4, kTickSpacing, 14), Qt::AlignCenter,
                     metres(at));
  }
  painter.drawText(QRectF(raster.left(), raster.bottom() + 17, std::max(raster.width(), 120.0), 14),
                   Qt::AlignLeft, tr("along strike, m"));
  if (!with_down) return;
  const double down_step = round_step(kDownSpacing / scale);
  for (double at = 0; at * scale < raster.height(); at += down_step) {
    const double y = raster.top() + at * scale;
    painter.drawLine(QPointF(raster.left() - 4, y), QPointF(raster.left(), y));
    painter.drawText(QRectF(raster.left() - 46, y - 8, 40, 16), Qt::AlignRight | Qt::AlignVCenter,
                     metres(at));
  }
  painter.save();
  painter.translate(12, raster.center().y());
  painter.rotate(-90);
  painter.drawText(QRectF(-80, -9, 160, 18), Qt::AlignCenter, tr("down dip, m"));
  painter.restore();
}

void CompareView::draw_bar(QPainter& painter, const QRectF& bar, const ComparedImages::Panel& panel) const {
  const auto& table = render::ColourMap::named(panel.colour_map).table();
  const double width = bar.width() * 0.8;
  for (std::size_t n = 0; n < table.size(); ++n) {
    const double from = bar.left() + width * static_cast<double>(n) / static_cast<double>(table.size());
    painter.fillRect(
        QRectF(from, bar.top(), width / static_cast<double>(table.size()) + 1, 10),
        QColor(static_cast<int>(render::red(table[n])), static_cast<int>(render::green(table[n])),
               static_cast<int>(render::blue(table[n]))));
  }
  painter.setPen(palette().color(QPalette::Text));
  const QRectF below(bar.left(), bar.top() + 12, width, 16);
  painter.drawText(below, Qt::AlignLeft, number(panel.range.lo));
  painter.drawText(below, Qt::AlignRight, number(panel.range.hi));
  painter.drawText(below, Qt::AlignCenter, QString::fromStdString(compared_->comparison.unit));
}

void CompareView::mouseMoveEvent(QMouseEvent* event) {
  Q_EMIT pointed(read_out(event->position()));
}

void CompareView::leaveEvent(QEvent*) {
  Q_EMIT pointed(QString());
}

}  // namespace footwall::ui
