#include "ui/scene3d/panels.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <cmath>
#include <numbers>

namespace footwall::ui {
namespace {

QString words(const char* text) {
  return QCoreApplication::translate("SceneView", text);
}

QString state_text(Freshness state) {
  switch (state) {
    case Freshness::kFresh:
      return words("fresh");
    case Freshness::kFollowing:
      return words("following");
    case Freshness::kKept:
      return words("of a run");
    case Freshness::kStale:
      return words("stale");
    case Freshness::kPlain:
      break;
  }
  return words("not computed");
}

// A run's name may be long; the unit at its end stays.
QStringList shortened(QStringList lines, const QFontMetricsF& metrics) {
  constexpr double kWidest = 220;
  for (QString& one : lines) one = metrics.elidedText(one, Qt::ElideMiddle, kWidest);
  return lines;
}

double widest_of(const QStringList& lines, const QFontMetricsF& metrics) {
  double width = 0;
  for (const QString& one : lines) width = std::max(width, metrics.horizontalAdvance(one));
  return width;
}

QImage blank(double width, double height, double pixel) {
  QImage image(QSize(static_cast<int>(std::ceil(width * pixel)), static_cast<int>(std::ceil(height * pixel))),
               QImage::Format_RGBA8888_Premultiplied);
  image.setDevicePixelRatio(pixel);
  image.fill(0);
  return image;
}

}  // namespace

QStringList lines_above(const ColourBar& bar) {
  QStringList lines = bar.run.isEmpty() ? QStringList(state_text(bar.state)) : bar.run;
  if (!bar.unit.isEmpty()) lines.front() += QStringLiteral(", ") + bar.unit;
  if (!bar.run.isEmpty() && bar.state == Freshness::kStale) lines.append(words("hatched: moved since"));
  return lines;
}

QString line_below(const ColourBar& bar) {
  if (!bar.missing.isEmpty() || bar.state == Freshness::kPlain || bar.not_computed == 0) return bar.missing;
  QString text = bar.run.isEmpty() ? QCoreApplication::translate("SceneView", "%n fault(s) not computed",
                                                                 nullptr, bar.not_computed)
                                   : QCoreApplication::translate("SceneView", "%n fault(s) not in this run",
                                                                 nullptr, bar.not_computed);
  return text.replace(QStringLiteral("(s)"), bar.not_computed == 1 ? QString() : QStringLiteral("s"));
}

QImage colour_bar_image(const ColourBar& bar, const SceneColours& colours, const QFont& font, double pixel) {
  QFont small = font;
  small.setPixelSize(
      std::max(9, font.pixelSize() > 0 ? font.pixelSize() - 1 : QFontInfo(font).pixelSize() - 1));
  const QFontMetricsF metrics(small);
  const double line = std::ceil(metrics.height());
  const QStringList notes = shortened(lines_above(bar), metrics);
  constexpr double kPad = 10;
  constexpr double kBar = 14;
  constexpr double kLong = 132;
  constexpr int kTicks = 5;
  const bool has_scale = bar.state != Freshness::kPlain;
  const QString below = line_below(bar);
  const double width = 2 * kPad + std::max({metrics.horizontalAdvance(bar.title), widest_of(notes, metrics),
                                            metrics.horizontalAdvance(below), 88.0});
  const double top = kPad + (1 + static_cast<double>(notes.size())) * line + 6;
  const double scale = (has_scale ? kLong + kPad : 0) + (has_scale && bar.has_undefined ? line + 4 : 0);
  const double height = top + scale + (below.isEmpty() ? 0 : line + 4);
  QImage image = blank(width, height, pixel);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  QColor panel = colours.panel;
  panel.setAlphaF(0.93F);
  painter.setPen(QPen(colours.line, 1));
  painter.setBrush(panel);
  painter.drawRoundedRect(QRectF(0.5, 0.5, width - 1, height - 1), 4, 4);
  painter.setFont(small);
  painter.setPen(colours.text);
  painter.drawText(QPointF(kPad, kPad + metrics.ascent()), bar.title);
  painter.setPen(colours.dim);
  for (qsizetype n = 0; n < notes.size(); ++n)
    painter.drawText(QPointF(kPad, kPad + static_cast<double>(n + 1) * line + metrics.ascent()), notes[n]);
  painter.drawText(QPointF(kPad, top + scale + metrics.ascent() - 4), below);
  if (!has_scale) return image;
  painter.setRenderHint(QPainter::Antialiasing, false);
  const bool hatched = bar.state == Freshness::kStale && bar.run.isEmpty();
  for (int y = 0; y < static_cast<int>(kLong * pixel); ++y) {
    const double share = 1 - (y + 0.5) / (kLong * pixel);
    const render::Rgba c = bar.colours->table()[static_cast<std::size_t>(share * 255.999)];
    painter.fillRect(QRectF(kPad, top + y / pixel, kBar, 1 / pixel),
                     QColor(static_cast<int>(render::red(c)), static_cast<int>(render::green(c)),
                            static_cast<int>(render::blue(c))));
  }
  if (hatched)
    painter.fillRect(QRectF(kPad, top, kBar, kLong), QBrush(QColor(0, 0, 0, 110), Qt::FDiagPattern));
  painter.setRenderHint(QPainter::Antialiasing);
  const double step = (bar.range[1] - bar.range[0]) / (kTicks - 1);
  const int decimals =
      std::clamp(static_cast<int>(std::ceil(1 - std::log10(std::max(std::abs(step), 1e-12)))), 0, 8);
  const double largest = std::max(std::abs(bar.range[0]), std::abs(bar.range[1]));
  const bool plain = largest < 1e6 && largest >= 1e-4;
  for (int n = 0; n < kTicks; ++n) {
    const double value = bar.range[0] + step * n;
    const double y = top + kLong * (1 - static_cast<double>(n) / (kTicks - 1));
    const QString text = plain ? QString::number(value, 'f', decimals) : QString::number(value, 'e', 2);
    painter.setPen(colours.dim);
    painter.drawLine(QPointF(kPad + kBar, y), QPointF(kPad + kBar + 3, y));
    const double base = std::clamp(y + metrics.ascent() / 2 - 1, top + metrics.ascent() - 2, top + kLong + 1);
    painter.drawText(QPointF(kPad + kBar + 7, base), text);
  }
  if (bar.has_undefined) {
    const double y = top + kLong + 6;
    painter.fillRect(QRectF(kPad, y + 2, kBar, line - 4), QColor(0x6b, 0x70, 0x79));
    painter.drawText(QPointF(kPad + kBar + 7, y + metrics.ascent()), words("no value"));
  }
  return image;
}

QImage north_arrow_image(double degrees, double length, const SceneColours& colours, const QFont& font,
                         double pixel) {
  constexpr double kSize = 64;
  QImage image = blank(kSize, kSize, pixel);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(kSize / 2, kSize / 2);
  const double reach = 6 + 14 * length;
  const double a = degrees * std::numbers::pi / 180;
  const QPointF along(std::sin(a), -std::cos(a));
  const QPointF across(along.y(), -along.x());
  painter.setPen(QPen(colours.text, 1.6, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(-along * reach, along * (reach - 5));
  painter.setPen(Qt::NoPen);
  painter.setBrush(colours.text);
  painter.drawPolygon(
      QPolygonF({along * reach, along * (reach - 9) + across * 4.5, along * (reach - 9) - across * 4.5}));
  painter.setFont(font);
  painter.setPen(colours.dim);
  const QFontMetricsF metrics(font);
  const QPointF at = along * (reach + 8);
  painter.drawText(at + QPointF(-metrics.horizontalAdvance(u'N') / 2, metrics.ascent() / 2 - 1),
                   QStringLiteral("N"));
  return image;
}

}  // namespace footwall::ui
