#include "ui/section/sample_image.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace footwall::ui {
namespace {

constexpr double kTexelPixels = 6;

// The samples that a row or column of pixels takes, as place and weights.
struct Taps {
  int first = 0;
  std::vector<float> weights;  // empty: outside the plane
};

// at: the plane's coordinate of the pixel's middle; span: samples a pixel covers.
Taps taps_at(double at, double span, int count, bool interpolate) {
  if (!(at >= -0.5 && at < count - 0.5)) return {};
  if (!interpolate) return {static_cast<int>(std::clamp<long>(std::lround(at), 0, count - 1)), {1}};
  if (span <= 1) {
    const double inside = std::clamp(at, 0.0, count - 1.0);
    const int below = std::min(static_cast<int>(inside), std::max(count - 2, 0));
    const auto part = static_cast<float>(inside - below);
    if (count == 1) return {0, {1}};
    return {below, {1 - part, part}};
  }
  const double low = std::max(at - span / 2, -0.5);
  const double high = std::min(at + span / 2, count - 0.5);
  const int first = std::clamp(static_cast<int>(std::lround(low)), 0, count - 1);
  const int last = std::clamp(static_cast<int>(std::lround(high)), 0, count - 1);
  Taps taps{first, {}};
  for (int n = first; n <= last; ++n) {
    taps.weights.push_back(
        static_cast<float>(std::max(1e-6, std::min(high, n + 0.5) - std::max(low, n - 0.5))));
  }
  float sum = 0;
  for (const float weight : taps.weights) sum += weight;
  for (float& weight : taps.weights) weight /= sum;
  return taps;
}

// A row of samples at the columns' pixels. NaN where half of what a pixel takes is NaN, or more.
void resample_row(const float* row, const std::vector<Taps>& columns, float* out) {
  for (std::size_t x = 0; x < columns.size(); ++x) {
    const Taps& taps = columns[x];
    float sum = 0;
    float weights = 0;
    for (std::size_t n = 0; n < taps.weights.size(); ++n) {
      const float value = row[static_cast<std::size_t>(taps.first) + n];
      if (std::isnan(value)) continue;
      sum += taps.weights[n] * value;
      weights += taps.weights[n];
    }
    out[x] = weights > 0.5F ? sum / weights : std::numeric_limits<float>::quiet_NaN();
  }
}

// Rows of samples at the columns' pixels, made when first needed.
class ResampledRows {
 public:
  ResampledRows(const SectionSamples& samples, const std::vector<Taps>& columns)
      : samples_(samples), columns_(columns), rows_(static_cast<std::size_t>(samples.rows)) {}
  const float* row(int number) {
    std::vector<float>& row = rows_[static_cast<std::size_t>(number)];
    if (row.empty()) {
      row.resize(columns_.size());
      resample_row(samples_.values.data() + static_cast<std::size_t>(number) * samples_.columns, columns_,
                   row.data());
    }
    return row.data();
  }

 private:
  const SectionSamples& samples_;
  const std::vector<Taps>& columns_;
  std::vector<std::vector<float>> rows_;
};

}  // namespace

bool interpolates(const SampleLook& look, const ViewTransform& view, double pixel_ratio) {
  if (look.interpolate) return *look.interpolate;
  return std::max(view.pixels_per_u(), view.pixels_per_v()) * pixel_ratio <= kTexelPixels;
}

QImage sample_image(const SectionSamples& samples, const SampleColours& colours, const ViewTransform& view,
                    double pixel_ratio, bool interpolate, QRgb nothing) {
  const int width = std::max(1, static_cast<int>(std::lround(view.area().width() * pixel_ratio)));
  const int height = std::max(1, static_cast<int>(std::lround(view.area().height() * pixel_ratio)));
  QImage image(width, height, QImage::Format_RGB32);
  image.setDevicePixelRatio(pixel_ratio);
  const auto place = [&](double x, double y) {
    return view.to_plane(view.area().topLeft() + QPointF(x, y) / pixel_ratio);
  };
  std::vector<Taps> columns;
  columns.reserve(static_cast<std::size_t>(width));
  const double span_u = 1 / (view.pixels_per_u() * pixel_ratio);
  const double span_v = 1 / (view.pixels_per_v() * pixel_ratio);
  for (int x = 0; x < width; ++x)
    columns.push_back(taps_at(place(x + 0.5, 0).u, span_u, samples.columns, interpolate));

  ResampledRows rows(samples, columns);
  std::vector<float> sums(static_cast<std::size_t>(width));
  std::vector<float> weights(static_cast<std::size_t>(width));
  const QRgb* copied = nullptr;
  int copied_row = -1;
  for (int y = 0; y < height; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    const Taps taps = taps_at(place(0, y + 0.5).v, span_v, samples.rows, interpolate);
    if (taps.weights.empty()) {
      std::fill_n(line, width, nothing);
      continue;
    }
    const float* values = rows.row(taps.first);
    if (taps.weights.size() == 1 && taps.first == copied_row) {
      std::copy_n(copied, width, line);
      continue;
    }
    if (taps.weights.size() > 1) {
      std::ranges::fill(sums, 0.0F);
      std::ranges::fill(weights, 0.0F);
      for (std::size_t n = 0; n < taps.weights.size(); ++n) {
        const float* row = rows.row(taps.first + static_cast<int>(n));
        const float weight = taps.weights[n];
        for (int x = 0; x < width; ++x) {
          const bool known = row[x] == row[x];
          sums[x] += known ? weight * row[x] : 0.0F;
          weights[x] += known ? weight : 0.0F;
        }
      }
      for (int x = 0; x < width; ++x) {
        sums[x] = weights[x] > 0.5F ? sums[x] / weights[x] : std::numeric_limits<float>::quiet_NaN();
      }
      values = sums.data();
    }
    for (int x = 0; x < width; ++x) line[x] = values[x] == values[x] ? colours.colour_of(values[x]) : nothing;
    if (taps.weights.size() == 1) {
      copied = line;
      copied_row = taps.first;
    }
  }
  return image;
}

void draw_wiggles(QPainter& painter, const SectionSamples& samples, const SampleColours& colours,
                  const ViewTransform& view, const QColor& ink) {
  const PlanePoint top = view.to_plane(view.area().topLeft());
  const PlanePoint bottom = view.to_plane(view.area().bottomRight());
  const int every = std::max(1, static_cast<int>(std::ceil(kTexelPixels / view.pixels_per_u())));
  const int row_step = std::max(1, static_cast<int>(1 / view.pixels_per_v()));
  const int first_row =
      std::clamp(static_cast<int>(std::floor(std::min(top.v, bottom.v))), 0, samples.rows - 1);
  const int last_row =
      std::clamp(static_cast<int>(std::ceil(std::max(top.v, bottom.v))), 0, samples.rows - 1);
  const double middle = (colours.low() + colours.high()) / 2;
  const double reach = every * 0.9 / (colours.high() - colours.low()) * 2;  // columns a unit
  painter.save();
  painter.setClipRect(view.area());
  painter.setRenderHint(QPainter::Antialiasing);
  const int first = std::max(0, static_cast<int>(std::floor(top.u / every)) * every - every);
  for (int column = first; column < samples.columns && column <= bottom.u + every; column += every) {
    QPainterPath curve, lobes;
    bool open = false;
    double base_y = 0;
    const auto close = [&](double y) {
      if (open) lobes.lineTo(view.to_pixels({static_cast<double>(column), 0}).x(), y);
      open = false;
    };
    for (int row = first_row; row <= last_row; row += row_step) {
      const float value = samples.at(column, row);
      const QPointF rest = view.to_pixels({static_cast<double>(column), static_cast<double>(row)});
      if (std::isnan(value)) {
        close(base_y);
        continue;
      }
      const double swing = std::clamp((value - middle) * reach, -1.5 * every, 1.5 * every);
      const QPointF at = view.to_pixels({column + swing, static_cast<double>(row)});
      const bool begins = !open;
      if (begins) {
        curve.moveTo(at);
        lobes.moveTo(rest);
        open = true;
      } else {
        curve.lineTo(at);
      }
      lobes.lineTo(swing > 0 ? at : rest);
      base_y = rest.y();
    }
    close(base_y);
    painter.fillPath(lobes, ink);
    painter.strokePath(curve, QPen(ink, 1));
  }
  painter.restore();
}

}  // namespace footwall::ui
