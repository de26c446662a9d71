#include "ui/model/section_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/error.h"

namespace footwall::ui {
namespace {

constexpr double kMostSamples = 1 << 26;

}  // namespace

SectionSource::SectionSource(const std::filesystem::path& path, std::uint64_t number,
                             const survey::Index& origin, ChunkCache& cache)
    : reader_(path), number_(number), origin_(origin), cache_(cache) {
  for (int axis = 0; axis < 3; ++axis) {
    counts_[axis] = (info().dims[axis] + info().chunk[axis] - 1) / info().chunk[axis];
  }
}

survey::Box SectionSource::box_of(const survey::Index& place) const {
  survey::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = place[axis] * info().chunk[axis];
    box.hi[axis] = std::min(info().dims[axis], box.lo[axis] + info().chunk[axis]);
  }
  return box;
}

std::shared_ptr<const std::vector<float>> SectionSource::chunk(const survey::Index& place,
                                                               const std::function<bool()>& stop) {
  const std::pair key{number_, (place[0] * counts_[1] + place[1]) * counts_[2] + place[2]};
  if (auto kept = cache_.find(key)) return kept;
  if (stop()) return nullptr;
  const survey::Box box = box_of(place);
  auto values = std::make_shared<std::vector<float>>(static_cast<std::size_t>(box.count()));
  reader_.read(box, *values);
  cache_.add(key, values, values->size() * sizeof(float));
  return values;
}

// The section's index on the axis `fixed`, columns along `across`, rows along `down`.
bool SectionSource::fill_plane(SectionSamples& samples, int fixed, int across, int down,
                               const std::function<bool()>& stop) {
  const std::int64_t at = samples.section.index - origin_[fixed];
  if (at < 0 || at >= info().dims[fixed]) return true;
  survey::Index place{};
  place[fixed] = at / info().chunk[fixed];
  for (place[across] = 0; place[across] < counts_[across]; ++place[across]) {
    for (place[down] = 0; place[down] < counts_[down]; ++place[down]) {
      const auto values = chunk(place, stop);
      if (values == nullptr) return false;
      const survey::Box box = box_of(place);
      const survey::Index stride{box.size(1) * box.size(2), box.size(2), 1};
      const std::int64_t first_column = std::max<std::int64_t>(box.lo[across], -origin_[across]);
      const std::int64_t end_column = std::min(box.hi[across], samples.columns - origin_[across]);
      const std::int64_t first_row = std::max<std::int64_t>(box.lo[down], -origin_[down]);
      const std::int64_t end_row = std::min(box.hi[down], samples.rows - origin_[down]);
      const float* from = values->data() + (at - box.lo[fixed]) * stride[fixed];
      for (std::int64_t row = first_row; row < end_row; ++row) {
        float* out = samples.values.data() + (row + origin_[down]) * samples.columns + origin_[across];
        const float* in = from + (row - box.lo[down]) * stride[down];
        for (std::int64_t column = first_column; column < end_column; ++column) {
          out[column] = in[(column - box.lo[across]) * stride[across]];
        }
      }
    }
  }
  return true;
}

bool SectionSource::fill_line(SectionSamples& samples, const std::function<bool()>& stop) {
  for (int column = 0; column < samples.columns; ++column) {
    const survey::IndexPoint p = index_of(samples.section, {static_cast<double>(column), 0});
    const std::int64_t i = std::llround(p.i) - origin_[0];
    const std::int64_t j = std::llround(p.j) - origin_[1];
    if (i < 0 || j < 0 || i >= info().dims[0] || j >= info().dims[1]) continue;
    survey::Index place{i / info().chunk[0], j / info().chunk[1], 0};
    for (place[2] = 0; place[2] < counts_[2]; ++place[2]) {
      const auto values = chunk(place, stop);
      if (values == nullptr) return false;
      const survey::Box box = box_of(place);
      const float* trace = values->data() + ((i - box.lo[0]) * box.size(1) + (j - box.lo[1])) * box.size(2);
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
        const std::int64_t row = k + origin_[2];
        if (row >= 0 && row < samples.rows)
          samples.values[row * samples.columns + column] = trace[k - box.lo[2]];
      }
    }
  }
  return true;
}

std::optional<SectionSamples> SectionSource::read(Id volume, const Section& section,
                                                  const survey::Geometry& survey,
                                                  const std::function<bool()>& stop) {
  const PlaneSize size = size_of(section, survey);
  if (!(size.width * size.height <= kMostSamples)) {
    throw Error(ErrorCode::kInvalid, "the line is too long to be shown", "draw one within the survey");
  }
  SectionSamples samples{.volume = volume,
                         .section = section,
                         .columns = static_cast<int>(size.width),
                         .rows = static_cast<int>(size.height),
                         .values = {}};
  samples.values.assign(static_cast<std::size_t>(samples.columns) * samples.rows,
                        std::numeric_limits<float>::quiet_NaN());
  bool whole = true;
  switch (section.kind) {
    case Section::Kind::kInline:
      whole = fill_plane(samples, 0, 1, 2, stop);
      break;
    case Section::Kind::kCrossline:
      whole = fill_plane(samples, 1, 0, 2, stop);
      break;
    case Section::Kind::kSlice:
      whole = fill_plane(samples, 2, 1, 0, stop);
      break;
    case Section::Kind::kLine:
      whole = fill_line(samples, stop);
      break;
  }
  if (!whole) return std::nullopt;
  return samples;
}

// Where a volume has both signs, the percentiles of |value| come from the values' distribution: a broken line
// through its percentiles (good in the middle) and the edges of its histogram (good in the tails).
SectionReader::VolumeFacts facts_of(const volume::Statistics& statistics) {
  SectionReader::VolumeFacts facts;
  facts.signed_values = statistics.min < 0 && statistics.max > 0;
  facts.max_abs = statistics.max_abs;
  facts.percentiles = statistics.percentiles;
  if (!facts.signed_values || statistics.count == 0) {
    facts.percentiles.resize(101, statistics.max);
    return facts;
  }
  std::vector<std::pair<double, double>> curve;  // value, share of the samples at or below it
  for (std::size_t p = 0; p < statistics.percentiles.size(); ++p) {
    curve.emplace_back(statistics.percentiles[p], static_cast<double>(p) / 100);
  }
  const volume::Histogram& histogram = statistics.histogram;
  double below = 0;
  for (int bin = 0; bin < volume::Histogram::kBins; ++bin) {
    below += static_cast<double>(histogram.counts[bin]);
    curve.emplace_back(histogram.lo + (bin + 1) * (histogram.hi - histogram.lo) / volume::Histogram::kBins,
                       below / static_cast<double>(statistics.count));
  }
  std::ranges::sort(curve);
  for (std::size_t n = 1; n < curve.size(); ++n)
    curve[n].second = std::max(curve[n].second, curve[n - 1].second);
  const auto share_below = [&](double value) {
    const auto above = std::ranges::lower_bound(curve, value, {}, &std::pair<double, double>::first);
    if (above == curve.begin()) return 0.0;
    if (above == curve.end()) return 1.0;
    const auto& [x0, y0] = *std::prev(above);
    const auto& [x1, y1] = *above;
    return x1 > x0 ? y0 + (y1 - y0) * (value - x0) / (x1 - x0) : y1;
  };
  facts.percentiles.assign(101, statistics.max_abs);
  for (int p = 0; p < 100; ++p) {
    double low = 0, high = statistics.max_abs;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = (low + high) / 2;
      (share_below(middle) - share_below(-middle) < p / 100.0 ? low : high) = middle;
    }
    facts.percentiles[static_cast<std::size_t>(p)] = high;
  }
  return facts;
}

}  // namespace footwall::ui
