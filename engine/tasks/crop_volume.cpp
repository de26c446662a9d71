#include "engine/tasks/crop_volume.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

constexpr std::int64_t kMostRead = std::int64_t{16} << 20;  // samples, of one inline of a block

// Wanted old indices: first, first + step, ...
struct Picked {
  std::int64_t first = 0;
  std::int64_t step = 1;
  std::int64_t count = 1;

  std::int64_t old_of(std::int64_t index) const { return first + index * step; }
};

// One alone has no step: the file's stays.
Picked picked(std::int64_t first, std::int64_t step, std::int64_t last) {
  const std::int64_t count = (last - first) / step + 1;
  return {first, count == 1 ? 1 : step, count};
}

[[noreturn]] void nothing_left(std::string_view axis, const std::string& asked, const std::string& there) {
  throw Error(ErrorCode::kInvalid, fmt::format("no {} is left of {}: the file has {}", axis, asked, there),
              "choose a range inside the file's");
}

std::string text_of(const LineRange& range) {
  const auto end = [](const std::optional<std::int64_t>& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  return fmt::format("{}:{}{}", end(range.first), end(range.last),
                     range.step ? fmt::format(":{}", *range.step) : "");
}

std::string text_of(const DepthRange& range) {
  const auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  return fmt::format("{}:{}{}", end(range.first), end(range.last),
                     range.step ? fmt::format(":{}", *range.step) : "");
}

Picked pick_lines(std::string_view axis, const survey::LineAxis& lines, const LineRange& range,
                  std::vector<std::string>& notices) {
  const std::string asked = text_of(range);
  const std::string there = fmt::format("{} {} to {} by {}", axis, lines.first, lines.last(), lines.step);
  const std::int64_t step = range.step.value_or(lines.step);
  if (step < 1 || step % lines.step != 0) {
    throw Error(
        ErrorCode::kUsage,
        fmt::format("{} {}: a step of {} is no multiple of the file's {}", axis, asked, step, lines.step),
        fmt::format("use a multiple of {}; --resample makes any other spacing", lines.step));
  }
  const std::int64_t first = std::max<std::int64_t>(range.first.value_or(lines.first), lines.first);
  const std::int64_t last = std::min(range.last.value_or(lines.last()), lines.last());
  if (first > last) nothing_left(axis, asked, there);
  // The first line at or after the wanted number.
  const std::int64_t index = (first - lines.first + lines.step - 1) / lines.step;
  if (lines.line_of(index) > last) nothing_left(axis, asked, there);
  if (range.first.value_or(first) < first || range.last.value_or(last) > last) {
    notices.push_back(
        fmt::format("{} {} reach beyond the file and are clipped: it has {}", axis, asked, there));
  }
  return picked(index, step / lines.step, (last - lines.first) / lines.step);
}

Picked pick_samples(const survey::Geometry& geometry, const DepthRange& range,
                    std::vector<std::string>& notices) {
  const std::string asked = text_of(range);
  const double end = geometry.z0 + geometry.interval * static_cast<double>(geometry.samples - 1);
  const std::string there = fmt::format("z {} to {} by {}", geometry.z0, end, geometry.interval);
  const double ratio = range.step.value_or(geometry.interval) / geometry.interval;
  const double stride = std::nearbyint(ratio);
  if (!(stride >= 1) || std::abs(ratio - stride) > 1e-6 * stride ||
      stride > static_cast<double>(std::numeric_limits<std::int32_t>::max())) {
    throw Error(ErrorCode::kUsage,
                fmt::format("z {}: a step of {} is no multiple of the file's interval {}", asked, *range.step,
                            geometry.interval),
                "use a multiple of it; --resample makes any other interval");
  }
  // In samples; a millionth of an interval is no reason to leave one out.
  const auto last_index = static_cast<double>(geometry.samples - 1);
  const double from = range.first ? (*range.first - geometry.z0) / geometry.interval : 0;
  const double to = range.last ? (*range.last - geometry.z0) / geometry.interval : last_index;
  const double first = std::max(0.0, std::ceil(from - 1e-6));
  const double last = std::min(last_index, std::floor(to + 1e-6));
  if (!(first <= last)) nothing_left("sample", "z " + asked, there);
  if (from < -1e-6 || to > last_index + 1e-6) {
    notices.push_back(fmt::format("z {} reaches beyond the file and is clipped: it has {}", asked, there));
  }
  return picked(static_cast<std::int64_t>(first), static_cast<std::int64_t>(stride),
                static_cast<std::int64_t>(last));
}

survey::LineAxis picked_lines(const survey::LineAxis& lines, const Picked& wanted) {
  return {static_cast<std::int32_t>(lines.line_of(wanted.first)),
          static_cast<std::int32_t>(lines.step * wanted.step), wanted.count};
}

// Reads what is asked for of the part: whole boxes where every trace is wanted, else inline by inline.
class Part {
 public:
  Part(VolumeSource whole, std::array<Picked, 3> axes) : whole_(std::move(whole)), axes_(axes) {}

  void fill(const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
    if (axes_[0].step == 1 && axes_[1].step == 1 && axes_[2].step == 1) {
      const survey::Index by{axes_[0].first, axes_[1].first, axes_[2].first};
      survey::Box old = box;
      for (int axis = 0; axis < 3; ++axis) {
        old.lo[axis] += by[axis];
        old.hi[axis] += by[axis];
      }
      return whole_.fill(old, values, live);
    }
    const std::int64_t samples = (box.size(2) - 1) * axes_[2].step + 1;
    const std::int64_t across = (box.size(1) - 1) * axes_[1].step + 1;
    const std::int64_t at_once = across * samples <= kMostRead ? box.size(1) : 1;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; j += at_once) {
        survey::Box row = box;
        row.lo[0] = i;
        row.hi[0] = i + 1;
        row.lo[1] = j;
        row.hi[1] = j + at_once;
        const std::int64_t trace = (i - box.lo[0]) * box.size(1) + j - box.lo[1];
        fill_row(row, values.subspan(static_cast<std::size_t>(trace * box.size(2))),
                 live.subspan(static_cast<std::size_t>(trace)));
      }
    }
  }

 private:
  void fill_row(const survey::Box& row, std::span<float> values, std::span<std::uint8_t> live) {
    survey::Box old;
    for (int axis = 0; axis < 3; ++axis) {
      const Picked& wanted = axes_[static_cast<std::size_t>(axis)];
      old.lo[axis] = wanted.old_of(row.lo[axis]);
      old.hi[axis] = wanted.old_of(row.hi[axis] - 1) + 1;
    }
    samples_.resize(static_cast<std::size_t>(old.count()));
    live_.assign(static_cast<std::size_t>(old.size(1)), 1);
    whole_.fill(old, samples_, live_);
    float* to = values.data();
    for (std::int64_t j = 0; j < row.size(1); ++j) {
      const std::int64_t trace = j * axes_[1].step;
      live[static_cast<std::size_t>(j)] = live_[static_cast<std::size_t>(trace)];
      const float* from = samples_.data() + trace * old.size(2);
      for (std::int64_t k = 0; k < row.size(2); ++k) *to++ = from[k * axes_[2].step];
    }
  }

  VolumeSource whole_;
  std::array<Picked, 3> axes_;  // inlines, crosslines, samples
  std::vector<float> samples_;
  std::vector<std::uint8_t> live_;
};

}  // namespace

VolumeSource cropped(VolumeSource source, const Crop& crop, std::vector<std::string>& notices) {
  if (crop.whole()) return source;
  const survey::Geometry& old = source.geometry;
  const std::array axes{
      pick_lines("inlines", old.inlines, crop.inlines.value_or(LineRange{}), notices),
      pick_lines("crosslines", old.crosslines, crop.crosslines.value_or(LineRange{}), notices),
      pick_samples(old, crop.z.value_or(DepthRange{}), notices)};
  VolumeSource part;
  part.null_value = source.null_value;
  part.role = source.role;
  part.text = source.text;
  part.geometry = old;
  survey::Geometry& made = part.geometry;
  made.inlines = picked_lines(old.inlines, axes[0]);
  made.crosslines = picked_lines(old.crosslines, axes[1]);
  made.samples = axes[2].count;
  made.z0 = old.z0 + static_cast<double>(axes[2].first) * old.interval;
  made.interval = old.interval * static_cast<double>(axes[2].step);
  const survey::WorldPoint origin =
      old.world_of({static_cast<double>(axes[0].first), static_cast<double>(axes[1].first), 0});
  const auto i_step = static_cast<double>(axes[0].step);
  const auto j_step = static_cast<double>(axes[1].step);
  made.map = {origin.x,
              origin.y,
              old.map.per_inline_x * i_step,
              old.map.per_inline_y * i_step,
              old.map.per_crossline_x * j_step,
              old.map.per_crossline_y * j_step};

  nlohmann::json provenance = nlohmann::json::parse(source.provenance_json);
  provenance["crop"] = {
      {"inlines", {made.inlines.first, made.inlines.last(), made.inlines.step}},
      {"crosslines", {made.crosslines.first, made.crosslines.last(), made.crosslines.step}},
      {"z", {made.z0, made.z0 + made.interval * static_cast<double>(made.samples - 1), made.interval}}};
  part.provenance_json = provenance.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const auto reading = std::make_shared<Part>(std::move(source), axes);
  part.fill = [reading](const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
    reading->fill(box, values, live);
  };
  return part;
}

}  // namespace footwall::tasks
