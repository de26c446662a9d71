#include "ui/images/image_difference.h"

#include <QDir>
#include <algorithm>
#include <array>
#include <cmath>

namespace footwall::ui {
namespace {

constexpr int kBlock = 4;

// sRGB, 0 to 255, to CIE Lab under D65.
std::array<double, 3> lab_of(const QColor& colour) {
  const auto linear = [](int byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double r = linear(colour.red()), g = linear(colour.green()), b = linear(colour.blue());
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

std::array<double, 3> mean_of(const QImage& image, int left, int top) {
  std::array<double, 3> sum{};
  int count = 0;
  for (int y = top; y < std::min(top + kBlock, image.height()); ++y) {
    for (int x = left; x < std::min(left + kBlock, image.width()); ++x) {
      const std::array<double, 3> lab = lab_of(image.pixelColor(x, y));
      for (std::size_t n = 0; n < 3; ++n) sum[n] += lab[n];
      ++count;
    }
  }
  for (double& one : sum) one /= count;
  return sum;
}

}  // namespace

ImageDifference difference_of(const QImage& a, const QImage& b) {
  ImageDifference result;
  if (a.size() != b.size() || a.isNull()) return result;
  result.picture = a.convertToFormat(QImage::Format_Grayscale8).convertToFormat(QImage::Format_RGB32);
  int blocks = 0, different = 0;
  for (int top = 0; top < a.height(); top += kBlock) {
    for (int left = 0; left < a.width(); left += kBlock) {
      const auto p = mean_of(a, left, top);
      const auto q = mean_of(b, left, top);
      const double away = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      result.largest = std::max(result.largest, away);
      ++blocks;
      if (away <= ImageDifference::kSeen) continue;
      ++different;
      const int red = std::min(255, 120 + static_cast<int>(4 * away));
      for (int y = top; y < std::min(top + kBlock, a.height()); ++y) {
        for (int x = left; x < std::min(left + kBlock, a.width()); ++x)
          result.picture.setPixel(x, y, qRgb(red, 0, 0));
      }
    }
  }
  result.share = static_cast<double>(different) / blocks;
  return result;
}

QString compare_with_baseline(const QImage& picture, const QString& name) {
  const QString baseline = QDir(QStringLiteral(FOOTWALL_BASELINES)).filePath(name + QStringLiteral(".png"));
  if (picture.isNull()) return QStringLiteral("there is no picture");
  if (qEnvironmentVariableIsSet("FOOTWALL_MAKE_BASELINES"))
    return picture.save(baseline) ? QString() : QStringLiteral("%1 cannot be written").arg(baseline);
  const QImage wanted(baseline);
  if (wanted.isNull()) return QStringLiteral("there is no baseline %1").arg(baseline);
  const ImageDifference difference = difference_of(wanted, picture);
  if (difference.is_small()) return {};
  const QDir failures(QStringLiteral(FOOTWALL_IMAGE_FAILURES));
  const QString made = failures.filePath(name + QStringLiteral(".png"));
  const QString seen = failures.filePath(name + QStringLiteral(".difference.png"));
  const bool written = QDir().mkpath(failures.path()) && picture.save(made) &&
                       (difference.picture.isNull() || difference.picture.save(seen));
  return QStringLiteral("%1 % of the blocks look different, the worst by %2 of Lab: %3")
      .arg(100 * difference.share, 0, 'f', 2)
      .arg(difference.largest, 0, 'f', 1)
      .arg(written ? QStringLiteral("compare %1 with %2; the difference is in %3").arg(made, baseline, seen)
                   : QStringLiteral("and the pictures cannot be written to %1").arg(failures.path()));
}

}  // namespace footwall::ui
