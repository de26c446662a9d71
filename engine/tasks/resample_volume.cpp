#include "engine/tasks/resample_volume.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

#include "engine/tasks/resample_kernel.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

constexpr float kNull = std::numeric_limits<float>::quiet_NaN();
constexpr std::int64_t kWorthThreads = 1 << 15;  // samples

// A plane of one old inline, already on the new crosslines and samples, and which of its traces live.
struct Plane {
  std::vector<float> values;  // [crossline][sample]
  std::vector<std::uint8_t> live;
};

class Resampling {
 public:
  Resampling(VolumeSource old, const std::array<AxisPlace, 3>& places)
      : old_(std::move(old)), axes_{Taps(places[0]), Taps(places[1]), Taps(places[2])} {}

  void fill(const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
    if (box.lo[1] != lo_ || box.hi[1] != hi_ || box.lo[2] != first_sample_ || box.hi[2] != end_sample_) {
      planes_.clear();
      lo_ = box.lo[1];
      hi_ = box.hi[1];
      first_sample_ = box.lo[2];
      end_sample_ = box.hi[2];
    }
    const std::int64_t traces = box.size(1);
    const std::int64_t plane = traces * box.size(2);
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      const Taps::View taps = axes_[0].at(i);
      // The survey's lines may run against the file's.
      planes_.erase(planes_.begin(), planes_.lower_bound(taps.first));
      planes_.erase(planes_.lower_bound(taps.first + taps.count), planes_.end());
      for (std::int64_t t = 0; t < taps.count; ++t) ensure(taps.first + t, box);
      std::vector<const float*> rows;
      for (std::int64_t t = 0; t < taps.count; ++t) rows.push_back(planes_.at(taps.first + t).values.data());
      combine(taps, rows, plane, values.data() + (i - box.lo[0]) * plane);
      const auto& nearest = planes_.at(taps.first + taps.nearest).live;
      std::copy(nearest.begin(), nearest.end(), live.begin() + (i - box.lo[0]) * traces);
    }
  }

 private:
  void ensure(std::int64_t inline_index, const survey::Box& box) {
    if (planes_.contains(inline_index)) return;
    const survey::Box from{
        {inline_index, axes_[1].at(box.lo[1]).first, axes_[2].first_of(box.lo[2], box.hi[2])},
        {inline_index + 1, axes_[1].end_of(box.lo[1], box.hi[1]), axes_[2].end_of(box.lo[2], box.hi[2])}};
    read(from);
    const std::int64_t old_samples = from.size(2);
    const std::int64_t samples = box.size(2);
    along_samples_.resize(static_cast<std::size_t>(from.size(1) * samples));
#pragma omp parallel for schedule(static) if (from.count() > kWorthThreads)
    for (std::int64_t j = 0; j < from.size(1); ++j) {
      const float* trace = samples_.data() + j * old_samples;
      float* to = along_samples_.data() + j * samples;
      for (std::int64_t k = 0; k < samples; ++k) {
        const Taps::View taps = axes_[2].at(box.lo[2] + k);
        to[k] = combined(taps, trace + (taps.first - from.lo[2]), 1);
      }
    }
    Plane made;
    made.values.resize(static_cast<std::size_t>(box.size(1) * samples));
    made.live.resize(static_cast<std::size_t>(box.size(1)));
#pragma omp parallel for schedule(static) if (box.size(1) * samples > kWorthThreads)
    for (std::int64_t j = 0; j < box.size(1); ++j) {
      const Taps::View taps = axes_[1].at(box.lo[1] + j);
      std::vector<const float*> rows;
      for (std::int64_t t = 0; t < taps.count; ++t) {
        rows.push_back(along_samples_.data() + (taps.first - from.lo[1] + t) * samples);
      }
      combine(taps, rows, samples, made.values.data() + j * samples);
      made.live[static_cast<std::size_t>(j)] =
          live_[static_cast<std::size_t>(taps.first + taps.nearest - from.lo[1])];
    }
    planes_.emplace(inline_index, std::move(made));
  }

  // Old samples with every kind of null as NaN.
  void read(const survey::Box& from) {
    samples_.resize(static_cast<std::size_t>(from.count()));
    live_.assign(static_cast<std::size_t>(from.size(1)), 1);
    old_.fill(from, samples_, live_);
    const float null_value = old_.null_value.value_or(kNull);
    for (float& value : samples_) {
      if (value == null_value || !std::isfinite(value)) value = kNull;
    }
    for (std::int64_t j = 0; j < from.size(1); ++j) {
      if (live_[static_cast<std::size_t>(j)] == 0) {
        std::fill_n(samples_.begin() + j * from.size(2), from.size(2), kNull);
      }
    }
  }

  VolumeSource old_;
  std::array<Taps, 3> axes_;
  std::map<std::int64_t, Plane> planes_;  // by old inline, of the crosslines and samples below
  std::int64_t lo_ = 0, hi_ = 0, first_sample_ = 0, end_sample_ = 0;
  std::vector<float> samples_, along_samples_;
  std::vector<std::uint8_t> live_;
};

double new_step(std::int64_t old_count, std::int64_t new_count, std::string_view axis) {
  if ((old_count == 1) != (new_count == 1)) {
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("--resample: {} {} cannot become {} over the same extent", old_count, axis, new_count),
        "one alone has no extent; crop chooses a single line or sample");
  }
  return new_count == 1 ? 1 : static_cast<double>(old_count - 1) / static_cast<double>(new_count - 1);
}

survey::LineAxis new_lines(const survey::LineAxis& old, std::int64_t count, std::string_view axis,
                           std::vector<std::string>& assumed) {
  const std::int64_t extent = old.last() - old.first;
  if (count == 1 || (extent % (count - 1) == 0 && extent >= count - 1)) {
    return {old.first, count == 1 ? old.step : static_cast<std::int32_t>(extent / (count - 1)), count};
  }
  assumed.push_back(fmt::format("{} are numbered from 1: the resampled ones have no whole numbers", axis));
  return {1, 1, count};
}

// Survey lines whose old index lies inside the part: first index and count.
std::pair<std::int64_t, std::int64_t> inside(const AxisPlace& place, std::string_view axis) {
  const double slack = 1e-6;
  const double a = -place.offset / place.step;
  const double b = (static_cast<double>(place.old_count - 1) - place.offset) / place.step;
  const double lo = std::max(0.0, std::ceil(std::min(a, b) - slack));
  const double hi = std::min(static_cast<double>(place.new_count - 1), std::floor(std::max(a, b) + slack));
  if (!(lo <= hi)) {
    throw Error(ErrorCode::kInvalid, fmt::format("no {} of the survey lies inside the volume", axis),
                "the volume lies elsewhere: check its coordinates, line numbers and z");
  }
  return {static_cast<std::int64_t>(lo), static_cast<std::int64_t>(hi - lo) + 1};
}

AxisPlace by_numbers(const survey::LineAxis& from, const survey::LineAxis& to) {
  return {static_cast<double>(from.first - std::int64_t{to.first}) / to.step,
          static_cast<double>(from.step) / to.step, to.count, from.count};
}

std::pair<AxisPlace, AxisPlace> by_coordinates(const survey::Geometry& survey, const survey::Geometry& part) {
  const auto old_of = [&](double i, double j) { return part.index_of(survey.world_of({i, j, 0})); };
  const survey::IndexPoint origin = old_of(0, 0);
  const survey::IndexPoint next_inline = old_of(1, 0);
  const survey::IndexPoint next_crossline = old_of(0, 1);
  const std::pair<AxisPlace, AxisPlace> places{
      {origin.i, next_inline.i - origin.i, part.inlines.count, survey.inlines.count},
      {origin.j, next_crossline.j - origin.j, part.crosslines.count, survey.crosslines.count}};
  // How far, in old bins, the lines of one grid leave those of the other inside the part.
  const double drift_i = std::abs((next_crossline.i - origin.i) / places.second.step) *
                         static_cast<double>(part.crosslines.count);
  const double drift_j =
      std::abs((next_inline.j - origin.j) / places.first.step) * static_cast<double>(part.inlines.count);
  if (!(drift_i < 0.05 && drift_j < 0.05)) {
    throw Error(ErrorCode::kInvalid,
                "the volume's lines do not run along the survey's: it cannot be resampled to its grid",
                "import it into a project of its own");
  }
  return places;
}

}  // namespace

Regrid regridded(const survey::Geometry& geometry, const survey::Index& dims) {
  Regrid made{geometry, {}};
  const survey::Index old = geometry.dims();
  constexpr std::string_view kAxes[] = {"inlines", "crosslines", "samples"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    made.places[axis] = {0, new_step(old[axis], dims[axis], kAxes[axis]), old[axis], dims[axis]};
  }
  survey::Geometry& grid = made.geometry;
  grid.inlines = new_lines(geometry.inlines, dims[0], "inlines", grid.assumed);
  grid.crosslines = new_lines(geometry.crosslines, dims[1], "crosslines", grid.assumed);
  grid.samples = dims[2];
  grid.interval = geometry.interval * made.places[2].step;
  grid.map.per_inline_x *= made.places[0].step;
  grid.map.per_inline_y *= made.places[0].step;
  grid.map.per_crossline_x *= made.places[1].step;
  grid.map.per_crossline_y *= made.places[1].step;
  grid.validate();
  return made;
}

Regrid on_survey(const survey::Geometry& survey, const survey::Geometry& part) {
  if (survey.domain != part.domain || survey.vertical_unit != part.vertical_unit) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("the volume is {} in {}, the survey {} in {}: resampling does not convert",
                            name_of(part.domain), name_of(part.vertical_unit), name_of(survey.domain),
                            name_of(survey.vertical_unit)),
                "convert it first, or import it into a project of its own");
  }
  Regrid made{survey, {}};
  if (part.map == survey::MapView{}) {  // no coordinates of its own
    made.places[0] = by_numbers(survey.inlines, part.inlines);
    made.places[1] = by_numbers(survey.crosslines, part.crosslines);
  } else {
    std::tie(made.places[0], made.places[1]) = by_coordinates(survey, part);
  }
  made.places[2] = {(survey.z0 - part.z0) / part.interval, survey.interval / part.interval, part.samples,
                    survey.samples};
  constexpr std::string_view kAxes[] = {"inline", "crossline", "sample"};
  survey::Index first{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    AxisPlace& place = made.places[axis];
    std::tie(first[axis], place.new_count) = inside(place, kAxes[axis]);
    place.offset += static_cast<double>(first[axis]) * place.step;
  }
  survey::Geometry& grid = made.geometry;
  grid.inlines.first = static_cast<std::int32_t>(survey.inlines.line_of(first[0]));
  grid.inlines.count = made.places[0].new_count;
  grid.crosslines.first = static_cast<std::int32_t>(survey.crosslines.line_of(first[1]));
  grid.crosslines.count = made.places[1].new_count;
  grid.samples = made.places[2].new_count;
  const survey::WorldPoint origin = survey.world_of(
      {static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2])});
  grid.map.origin_x = origin.x;
  grid.map.origin_y = origin.y;
  grid.z0 = origin.z;
  return made;
}

VolumeSource resampled(VolumeSource source, const Regrid& grid) {
  nlohmann::json provenance = nlohmann::json::parse(source.provenance_json);
  const survey::Geometry& old = source.geometry;
  provenance["resample"] = {
      {"from_dims", old.dims()},
      {"from_inlines", {old.inlines.first, old.inlines.last(), old.inlines.step}},
      {"from_crosslines", {old.crosslines.first, old.crosslines.last(), old.crosslines.step}},
      {"from_z", {old.z0, old.interval}},
      {"dims", grid.geometry.dims()},
      {"old_samples_a_new_one", {grid.places[0].step, grid.places[1].step, grid.places[2].step}},
      {"method",
       "separable cubic convolution (Keys, six points), stretched where coarser, exact for linear fields"}};
  VolumeSource made;
  made.geometry = grid.geometry;
  made.role = source.role;
  made.text = source.text + ", resampled";
  made.provenance_json = provenance.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const auto working = std::make_shared<Resampling>(std::move(source), grid.places);
  made.fill = [working](const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
    working->fill(box, values, live);
  };
  return made;
}

}  // namespace footwall::tasks
