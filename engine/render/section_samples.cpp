#include "engine/render/section_samples.h"

#include <algorithm>
#include <cmath>

namespace footwall::render {
namespace {

constexpr double kPixelsOfASquare = 6;  // a texel larger than this is shown as a square
constexpr double kMostTaps = 8;

float at(const SectionPlane& s, int row, int column) {
  return s
      .values[static_cast<std::size_t>(std::clamp(row, 0, s.rows - 1)) * static_cast<std::size_t>(s.columns) +
              static_cast<std::size_t>(std::clamp(column, 0, s.columns - 1))];
}

double nearest(const SectionPlane& s, double row, double column) {
  return static_cast<double>(
      at(s, static_cast<int>(std::lround(row)), static_cast<int>(std::lround(column))));
}

// Neighbours that are null lend their weight to the others; a null sample stays null.
double interpolated(const SectionPlane& s, double row, double column) {
  if (std::isnan(nearest(s, row, column))) return NAN;
  const double row_floor = std::floor(row);
  const double column_floor = std::floor(column);
  double sum = 0;
  double weights = 0;
  for (int n = 0; n < 4; ++n) {
    const double u = (n & 1) != 0 ? row - row_floor : 1 - (row - row_floor);
    const double v = (n & 2) != 0 ? column - column_floor : 1 - (column - column_floor);
    const auto value = static_cast<double>(
        at(s, static_cast<int>(row_floor) + (n & 1), static_cast<int>(column_floor) + (n >> 1)));
    if (std::isnan(value)) continue;
    sum += u * v * value;
    weights += u * v;
  }
  return sum / weights;
}

}  // namespace

bool shows_squares(double row_step, double column_step, int per_pixel) {
  return std::max(row_step, column_step) * kPixelsOfASquare * per_pixel < 1;
}

double section_value(const SectionPlane& section, double row, double column, double row_step,
                     double column_step, bool squares) {
  if (!std::isfinite(row + column + row_step + column_step)) return NAN;  // on the plane's horizon
  row = std::clamp(row, -0.5, section.rows - 0.5);
  column = std::clamp(column, -0.5, section.columns - 0.5);
  if (squares) return nearest(section, row, column);
  const auto taps = [](double step) { return static_cast<int>(std::clamp(std::ceil(step), 1.0, kMostTaps)); };
  const int row_taps = taps(row_step);
  const int column_taps = taps(column_step);
  double sum = 0;
  int count = 0;
  for (int r = 0; r < row_taps; ++r) {
    for (int c = 0; c < column_taps; ++c) {
      const double value = interpolated(section, row + ((r + 0.5) / row_taps - 0.5) * row_step,
                                        column + ((c + 0.5) / column_taps - 0.5) * column_step);
      if (std::isnan(value)) continue;
      sum += value;
      ++count;
    }
  }
  return count > 0 ? sum / count : NAN;
}

}  // namespace footwall::render
