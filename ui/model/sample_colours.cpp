#include "ui/model/sample_colours.h"

#include <algorithm>
#include <cmath>

#include "engine/render/colour_map.h"

namespace footwall::ui {
namespace {

const render::ColourMap& map_named(const QString& name) {
  for (const render::ColourMap& map : render::ColourMap::all()) {
    if (name.toStdString() == map.name()) return map;
  }
  return render::ColourMap::named("grey");
}

// Between the whole percentiles.
double percentile(const SectionReader::VolumeFacts& facts, double p) {
  const double at = std::clamp(p, 0.0, 100.0);
  const auto below = static_cast<std::size_t>(std::min(99.0, std::floor(at)));
  const double part = at - static_cast<double>(below);
  return facts.percentiles[below] * (1 - part) + facts.percentiles[below + 1] * part;
}

}  // namespace

SampleColours::SampleColours(const SampleLook& look, const SectionReader::VolumeFacts* facts) {
  const render::ColourMap& map = map_named(look.colour_map);
  for (std::size_t n = 0; n < table_.size(); ++n) {
    const render::Rgba colour = map.table()[n];
    table_[n] = qRgb(static_cast<int>(render::red(colour)), static_cast<int>(render::green(colour)),
                     static_cast<int>(render::blue(colour)));
  }
  if (facts != nullptr && facts->percentiles.size() > 100) {
    const double gain = look.gain > 0 && std::isfinite(look.gain) ? look.gain : 1;
    signed_ = facts->signed_values;
    if (signed_) {
      high_ = percentile(*facts, look.clip_percentile) / gain;
      low_ = -high_;
    } else {
      low_ = percentile(*facts, 100 - look.clip_percentile);
      high_ = low_ + (percentile(*facts, look.clip_percentile) - low_) / gain;
    }
  }
  if (!(high_ > low_)) {  // all samples alike: the middle of the table
    const double around = std::max(std::abs(low_), 1.0) * 1e-3;
    low_ -= around;
    high_ += around;
  }
  per_value_ = static_cast<float>(256 / (high_ - low_));
}

}  // namespace footwall::ui
