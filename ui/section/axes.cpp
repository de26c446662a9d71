#include "ui/section/axes.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

QString tr(const char* text) {
  return QCoreApplication::translate("footwall::ui::Axes", text);
}

AxisScale lines(const QString& name, const survey::LineAxis& axis) {
  return {name, {}, static_cast<double>(axis.first), static_cast<double>(axis.step), true};
}

QString number_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  return QString::number(std::abs(value) < step * 1e-6 ? 0 : value, 'f', decimals);
}

QString length_text(double metres) {
  return metres >= 1000 ? QStringLiteral("%1 km").arg(metres / 1000) : QStringLiteral("%1 m").arg(metres);
}

// In a word, as one would say it of a colour map's end.
QString colour_name(const QColor& colour) {
  constexpr int kColourful = 40;  // of 255, between its strongest and its weakest part
  const auto [weakest, strongest] = std::minmax({colour.red(), colour.green(), colour.blue()});
  if (strongest - weakest < kColourful) {
    return colour.lightness() < 64 ? tr("black") : colour.lightness() > 191 ? tr("white") : tr("grey");
  }
  const int hue = colour.hsvHue();
  if (hue < 20 || hue >= 330) return tr("red");
  if (hue < 45) return tr("orange");
  if (hue < 70) return tr("yellow");
  if (hue < 165) return tr("green");
  if (hue < 200) return tr("cyan");
  return hue < 265 ? tr("blue") : tr("purple");
}

double round_up(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * decade >= least * (1 - 1e-9)) return digit * decade;
  }
  return 10 * decade;
}

void draw_scale_bar(QPainter& painter, const QRectF& strip, const ViewTransform& view,
                    const AxisColours& colours) {
  const double metres = round_length(110 / view.pixels_per_metre());
  const double width = metres * view.pixels_per_metre();
  const double y = std::round(strip.center().y()) + 0.5;
  const double x = view.area().left() + 0.5;
  painter.setPen(QPen(colours.dim, 1));
  painter.drawLine(QPointF(x, y), QPointF(x + width, y));
  painter.drawLine(QPointF(x, y - 3), QPointF(x, y + 3));
  painter.drawLine(QPointF(x + width, y - 3), QPointF(x + width, y + 3));
  QString text = length_text(metres);
  if (view.frame().vertical) text += QStringLiteral("   z \u00d7 %1").arg(view.stretch(), 0, 'g', 3);
  painter.drawText(QRectF(x + width + 6, strip.top(), strip.width(), strip.height()),
                   Qt::AlignVCenter | Qt::AlignLeft, text);
}

}  // namespace

AxisScale u_axis(const Section& section, const survey::Geometry& survey) {
  switch (section.kind) {
    case Section::Kind::kInline:
    case Section::Kind::kSlice:
      return lines(tr("crossline"), survey.crosslines);
    case Section::Kind::kCrossline:
      return lines(tr("inline"), survey.inlines);
    case Section::Kind::kLine:
      break;
  }
  const survey::WorldPoint a = survey.world_of(section.from);
  const survey::WorldPoint b = survey.world_of(section.to);
  const double voxels = std::hypot(section.to.i - section.from.i, section.to.j - section.from.j);
  const double length = std::hypot(a.x - b.x, a.y - b.y);
  return {tr("distance"), QString::fromStdString(survey.horizontal_unit), 0, voxels > 0 ? length / voxels : 1,
          false};
}

AxisScale v_axis(const Section& section, const survey::Geometry& survey) {
  if (section.kind == Section::Kind::kSlice) return lines(tr("inline"), survey.inlines);
  return {survey.domain == survey::Domain::kTime ? tr("time") : tr("depth"),
          QString::fromUtf8(survey::name_of(survey.vertical_unit).data()), survey.z0, survey.interval, false};
}

double round_length(double at_most) {
  const double decade = std::pow(10.0, std::floor(std::log10(at_most)));
  double best = decade;
  for (const double digit : {2.0, 5.0, 10.0}) {
    if (digit * decade <= at_most * (1 + 1e-9)) best = digit * decade;
  }
  return best;
}

std::vector<Tick> round_ticks(const AxisScale& axis, double low, double high, double pixels_per_coordinate,
                              double spacing) {
  if (low > high) std::swap(low, high);
  if (axis.step == 0 || !(pixels_per_coordinate > 0) || !std::isfinite(low) || !std::isfinite(high))
    return {};
  double step = round_up(spacing / pixels_per_coordinate * std::abs(axis.step));
  if (axis.whole) step = std::max(step, 1.0);
  double from = axis.first + low * axis.step;
  double to = axis.first + high * axis.step;
  if (from > to) std::swap(from, to);
  std::vector<Tick> ticks;
  constexpr std::size_t kMost = 1000;
  for (double n = std::ceil(from / step - 1e-9); n * step <= to + step * 1e-9 && ticks.size() < kMost; ++n) {
    ticks.push_back({(n * step - axis.first) / axis.step, number_text(n * step, step)});
  }
  return ticks;
}

void draw_axes(QPainter& painter, const QRectF& bounds, const ViewTransform& view, const AxisScale& u,
               const AxisScale& v, const AxisColours& colours) {
  const QRectF& area = view.area();
  const PlanePoint first = view.to_plane(area.topLeft());
  const PlanePoint last = view.to_plane(area.bottomRight());
  const PlaneSize& size = view.frame().size;
  const auto inside = [](double low, double high, double count) {
    return std::pair{std::clamp(std::min(low, high), -0.5, count - 0.5),
                     std::clamp(std::max(low, high), -0.5, count - 0.5)};
  };
  const auto [u_low, u_high] = inside(first.u, last.u, size.width);
  const auto [v_low, v_high] = inside(first.v, last.v, size.height);
  const QRectF data = QRectF(view.to_pixels({u_low, v_low}), view.to_pixels({u_high, v_high})).normalized();
  const QFontMetricsF metrics(painter.font());
  const double height = metrics.height();

  double free_from = bounds.left();
  for (const Tick& tick : round_ticks(u, u_low, u_high, view.pixels_per_u(), 70)) {
    const double x = std::round(view.to_pixels({tick.coordinate, 0}).x()) + 0.5;
    painter.setPen(QPen(colours.grid, 1));
    painter.drawLine(QPointF(x, data.top()), QPointF(x, data.bottom()));
    painter.setPen(QPen(colours.line, 1));
    painter.drawLine(QPointF(x, area.top() - 4), QPointF(x, area.top() - 1));
    const double width = metrics.horizontalAdvance(tick.text);
    const double left = std::min(x - width / 2, bounds.right() - width - 2);
    if (left < free_from) continue;
    painter.setPen(colours.dim);
    painter.drawText(QPointF(left, area.top() - 6), tick.text);
    free_from = left + width + 6;
  }
  for (const Tick& tick : round_ticks(v, v_low, v_high, view.pixels_per_v(), 44)) {
    const double y = std::round(view.to_pixels({0, tick.coordinate}).y()) + 0.5;
    painter.setPen(QPen(colours.grid, 1));
    painter.drawLine(QPointF(data.left(), y), QPointF(data.right(), y));
    painter.setPen(QPen(colours.line, 1));
    painter.drawLine(QPointF(area.left() - 4, y), QPointF(area.left() - 1, y));
    if (y < area.top() + height / 2 - 2) continue;  // the corner says the unit
    painter.setPen(colours.dim);
    painter.drawText(QRectF(bounds.left(), y - height / 2, area.left() - 7 - bounds.left(), height),
                     Qt::AlignRight | Qt::AlignVCenter, tick.text);
  }
  painter.setPen(colours.dim);
  painter.drawText(
      QRectF(bounds.left() + 4, bounds.top(), area.left() - bounds.left() - 8, area.top() - bounds.top() - 2),
      Qt::AlignLeft | Qt::AlignBottom, v.unit.isEmpty() ? v.name : v.unit);
}

QString polarity_of(const SampleColours& samples, bool wiggles) {
  if (!samples.is_signed()) return {};
  return QStringLiteral("+ = %1").arg(wiggles ? tr("filled") : colour_name(samples.table().back()));
}

void draw_scale(QPainter& painter, const QRectF& strip, const ViewTransform& view,
                const SampleColours* samples, const QString& polarity, const QString& volume,
                const AxisColours& colours) {
  painter.setFont(painter.font());
  draw_scale_bar(painter, strip, view, colours);
  if (samples == nullptr || strip.width() < 360) return;
  const QFontMetricsF metrics(painter.font());
  QString high = QString::number(samples->high(), 'g', 3);
  if (!polarity.isEmpty()) high += QStringLiteral("   ") + polarity;
  const QString low = QString::number(samples->low(), 'g', 3);
  const double middle = strip.center().y();
  double right = view.area().right() - metrics.horizontalAdvance(high);
  painter.setPen(colours.dim);
  painter.drawText(QRectF(right, strip.top(), strip.width(), strip.height()),
                   Qt::AlignVCenter | Qt::AlignLeft, high);
  right -= 6;
  constexpr int kBar = 64;
  QImage bar(kBar, 1, QImage::Format_RGB32);
  for (int x = 0; x < kBar; ++x)
    bar.setPixel(x, 0, samples->table()[static_cast<std::size_t>(x) * 255 / (kBar - 1)]);
  painter.drawImage(QRectF(right - kBar, middle - 4, kBar, 8), bar);
  right -= kBar + 6;
  // The title tells the volume, too, so that its name may give way; half of it would tell nothing.
  constexpr double kScaleBar = 220;
  const QString named = volume + QStringLiteral("  ") + low;
  const bool fits = metrics.horizontalAdvance(named) <= right - strip.left() - kScaleBar;
  painter.drawText(QRectF(strip.left(), strip.top(), right - strip.left(), strip.height()),
                   Qt::AlignVCenter | Qt::AlignRight, fits ? named : low);
}

}  // namespace footwall::ui
