#include "ui/dialogs/segy_line_view.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

namespace segy = formats::segy;

constexpr int kLeft = 56;
constexpr int kTop = 22;

// 1, 2 or 5 times a power of ten, so that `range` has about `parts` of it.
double round_step(double range, double parts) {
  const double raw = range / std::max(1.0, parts);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

}  // namespace

double clip_of(const std::vector<float>& values, double percentile) {
  std::vector<float> sizes;
  sizes.reserve(values.size());
  for (const float value : values) {
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  }
  if (sizes.empty()) return 0;
  const auto last = static_cast<double>(sizes.size() - 1);
  const auto at = sizes.begin() + std::lround(last * std::clamp(percentile, 0.0, 100.0) / 100);
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

QImage grey_of(const segy::LinePreview& line, double clip) {
  QImage image(static_cast<int>(line.traces), static_cast<int>(line.samples), QImage::Format_ARGB32);
  const double scale = clip > 0 ? 127.5 / clip : 0;
  for (int row = 0; row < image.height(); ++row) {
    auto* pixels = reinterpret_cast<QRgb*>(image.scanLine(row));
    for (int column = 0; column < image.width(); ++column) {
      const float value = line.values[static_cast<std::size_t>(column * line.samples + row)];
      const int grey = std::isnan(value)
                           ? 0
                           : std::clamp(static_cast<int>(std::lround(std::clamp(
                                            127.5 + scale * static_cast<double>(value), 0.0, 255.0))),
                                        0, 255);
      pixels[column] = std::isnan(value) ? qRgba(0, 0, 0, 0) : qRgb(grey, grey, grey);
    }
  }
  return image;
}

SegyLineView::SegyLineView(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Preview of a line"));
}

void SegyLineView::show_look(std::shared_ptr<const SegyLook> look, const QString& unit) {
  if (look && (!look_ || look_ != look) && look->line.traces > 0) {
    image_ = grey_of(look->line, clip_of(look->line.values, 99));
  } else if (!look || look->line.traces == 0) {
    image_ = {};
  }
  look_ = std::move(look);
  unit_ = unit;
  update();
}

void SegyLineView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  painter.setPen(palette().color(QPalette::PlaceholderText));
  if (image_.isNull()) {
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     look_ ? tr("nothing to preview") : tr("reading …"));
    return;
  }
  const QRectF area = QRectF(rect()).adjusted(kLeft, kTop, -4, -4);
  painter.setRenderHint(QPainter::SmoothPixmapTransform, image_.height() > area.height());
  painter.drawImage(area, image_);

  const segy::LinePreview& line = look_->line;
  const segy::Inspection& found = look_->survey->found();
  const QFontMetricsF metrics(font());
  // z in the unit where it is known, else the number of the sample.
  const bool has_z = found.geometry && !unit_.isEmpty();
  const double first = has_z ? found.geometry->z0 : 0;
  const double each = (has_z ? found.geometry->interval : 1) * static_cast<double>(line.sample_step);
  const double depth = each * static_cast<double>(line.samples);
  const double step = round_step(depth, area.height() / 48);
  for (auto n = std::llround(std::ceil(first / step)); static_cast<double>(n) * step < first + depth; ++n) {
    const double z = static_cast<double>(n) * step;
    const double y =
        area.top() + area.height() * ((z - first) / each + 0.5) / static_cast<double>(line.samples);
    if (y > area.bottom() - 4) break;
    painter.drawLine(QPointF(area.left() - 4, y), QPointF(area.left(), y));
    painter.drawText(QRectF(0, y - metrics.height() / 2, area.left() - 6, metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter, QString::number(z, 'g', 7));
  }
  painter.drawText(QRectF(0, 0, area.left() - 6, area.top()), Qt::AlignRight | Qt::AlignVCenter,
                   has_z ? unit_ : tr("sample"));
  const survey::LineAxis& across = line.of_inline ? *found.crosslines : *found.inlines;
  const double lines = static_cast<double>(across.last()) - static_cast<double>(across.first);
  const double line_step = std::max(1.0, round_step(std::max(lines, 1.0), area.width() / 80));
  for (auto tick = std::llround(std::ceil(across.first / line_step));
       static_cast<double>(tick) * line_step <= static_cast<double>(across.last()); ++tick) {
    const double n = static_cast<double>(tick) * line_step;
    const double x = area.left() + area.width() * ((n - across.first) / across.step + 0.5) /
                                       static_cast<double>(across.count);
    painter.drawLine(QPointF(x, area.top() - 4), QPointF(x, area.top()));
    const QString number = QString::number(n, 'f', 0);
    const double width = metrics.horizontalAdvance(number) + 2;
    const double left = std::max(x - width / 2, area.left());  // clear of the unit
    painter.drawText(QRectF(left, 0, width, area.top() - 4), Qt::AlignLeft | Qt::AlignBottom, number);
  }
}

}  // namespace footwall::ui
