#include "ui/dialogs/compared_images.h"

#include <cmath>
#include <utility>

namespace footwall::ui {
namespace {

constexpr const char* kDifferenceMap = "red-white-blue";

QRgb pixel_of(render::Rgba colour) {
  return qRgb(static_cast<int>(render::red(colour)), static_cast<int>(render::green(colour)),
              static_cast<int>(render::blue(colour)));
}

void paint(const tasks::ChartRaster& raster, const std::vector<double>& values,
           ComparedImages::Panel& panel) {
  panel.image =
      QImage(static_cast<int>(raster.columns), static_cast<int>(raster.rows), QImage::Format_ARGB32);
  const render::ColourMap& map = render::ColourMap::named(panel.colour_map);
  for (int row = 0; row < panel.image.height(); ++row) {
    auto* line = reinterpret_cast<QRgb*>(panel.image.scanLine(row));
    const double* from = values.data() + static_cast<std::int64_t>(row) * raster.columns;
    for (int column = 0; column < panel.image.width(); ++column) {
      const double value = from[column];
      line[column] = std::isfinite(value) ? pixel_of(map.colour_of(value, panel.range)) : qRgba(0, 0, 0, 0);
    }
  }
}

}  // namespace

const std::vector<double>& ComparedImages::values(std::size_t panel) const {
  return panel == 0 ? comparison.a : panel == 1 ? comparison.b : comparison.difference;
}

ComparedImages pictured(tasks::RunComparison comparison, const std::string& colour_map) {
  ComparedImages made;
  made.comparison = std::move(comparison);
  std::vector<double> both = made.comparison.a;
  both.insert(both.end(), made.comparison.b.begin(), made.comparison.b.end());
  const render::Range shared = render::percentile_range(both).value_or(render::Range{});
  std::vector<float> differences;
  for (const double value : made.comparison.difference) {
    if (std::isfinite(value)) differences.push_back(static_cast<float>(value));
  }
  const render::Range symmetric = render::symmetric_range(differences, 98).value_or(render::Range{-1, 1});
  made.panels[0] = {{}, shared, colour_map};
  made.panels[1] = {{}, shared, colour_map};
  made.panels[2] = {{}, symmetric, kDifferenceMap};
  for (std::size_t n = 0; n < 3; ++n) paint(made.comparison.raster, made.values(n), made.panels[n]);
  return made;
}

}  // namespace footwall::ui
