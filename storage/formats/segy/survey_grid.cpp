#include "storage/formats/segy/survey_grid.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "storage/base/error.h"

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kMostChecked = 4096;  // duplicates whose offsets are looked up

[[noreturn]] void refuse_lines(const HeaderBytes& at, const std::string& what) {
  throw Error(
      ErrorCode::kInvalid,
      fmt::format("{} (inline numbers read at byte {}, crossline numbers at byte {})", what, at.inline_number,
                  at.crossline_number),
      "line numbers may stand elsewhere in the trace headers: common pairs of bytes are 189 193, 9 21, 5 21, "
      "181 185 and 9 13");
}

std::int32_t offset_word(const detail::ReadOnlyFile& file, const Layout& layout, std::int64_t trace) {
  std::array<std::byte, kTraceHeaderBytes> header;
  file.read_at(layout.offset_of(trace), header);
  return read_trace_header(header, {}, layout.swap).offset;
}

// One entry a bin is left. Traces that share their lines are prestack where their offsets differ; a few are
// an accident of processing, and the first one is taken.
void settle(const detail::ReadOnlyFile& file, const Layout& layout, const HeaderBytes& at, HeaderScan& scan,
            Report& report) {
  std::int64_t checked = 0;
  std::int64_t differing = 0;
  scan.index.settle([&](const IndexEntry& first, const IndexEntry& again) {
    if (again.dead()) return;
    ++report.duplicates;
    if (checked >= kMostChecked) return;
    ++checked;
    if (offset_word(file, layout, first.trace()) != offset_word(file, layout, again.trace())) ++differing;
  });
  const auto bins = static_cast<std::int64_t>(scan.index.entries().size());
  if (report.duplicates == 0) return;
  const std::int64_t prestack = differing * report.duplicates / checked;
  if (prestack * 100 > bins) {
    throw Error(
        ErrorCode::kUnsupported,
        fmt::format("{}: prestack data, {} traces with several offsets in {} bins", file.path().string(),
                    scan.live, bins),
        "only stacked volumes are read: stack it, or extract one offset. Wrong positions of the line numbers "
        "can look like this too");
  }
  if (report.duplicates >= bins) {
    refuse_lines(at, fmt::format("{}: {} traces share {} pairs of line numbers", file.path().string(),
                                 scan.live, bins));
  }
  report.warnings.push_back(
      fmt::format("{} traces have the line numbers of an earlier one and are left out", report.duplicates));
}

survey::LineAxis axis_of(std::int64_t lowest, std::int64_t highest, std::int64_t step, std::string_view what,
                         const HeaderBytes& at) {
  constexpr std::int64_t kMostLines = std::int64_t{1} << 23;
  if (step == 0) step = 1;
  const std::int64_t count = (highest - lowest) / step + 1;
  if (count > kMostLines || step > std::numeric_limits<std::int32_t>::max()) {
    refuse_lines(at, fmt::format("{} numbers from {} to {} in steps of {} make no survey", what, lowest,
                                 highest, step));
  }
  return {static_cast<std::int32_t>(lowest), static_cast<std::int32_t>(step), count};
}

void set_lines(const HeaderScan& scan, const HeaderBytes& at, survey::Geometry& geometry) {
  const auto& entries = scan.index.entries();
  std::int64_t lowest[2], highest[2], step[2] = {0, 0};
  const std::int64_t first[2] = {entries.front().inline_number, entries.front().crossline_number};
  for (int axis = 0; axis < 2; ++axis) lowest[axis] = highest[axis] = first[axis];
  for (const IndexEntry& entry : entries) {
    const std::int64_t line[2] = {entry.inline_number, entry.crossline_number};
    for (int axis = 0; axis < 2; ++axis) {
      lowest[axis] = std::min(lowest[axis], line[axis]);
      highest[axis] = std::max(highest[axis], line[axis]);
      // Most differences are multiples of the step found so far, which the remainder tells faster than gcd.
      const std::int64_t difference = line[axis] - first[axis];
      if (step[axis] == 0 || difference % step[axis] != 0) step[axis] = std::gcd(step[axis], difference);
    }
  }
  geometry.inlines = axis_of(lowest[0], highest[0], step[0], "inline", at);
  geometry.crosslines = axis_of(lowest[1], highest[1], step[1], "crossline", at);
  const auto traces = static_cast<std::int64_t>(entries.size());
  const std::int64_t bins = geometry.inlines.count * geometry.crosslines.count;
  if (bins > 100 * traces + 10000) {
    refuse_lines(at, fmt::format("{} traces are strewn over {} x {} lines", traces, geometry.inlines.count,
                                 geometry.crosslines.count));
  }
}

// Angles would be taken for metres; the mark alone is often wrong, so the values have to be possible, too.
bool coordinates_are_angles(const HeaderScan& scan, Report& report) {
  const double unit = scan.coordinate_unit.value;
  if (unit != 2 && unit != 3 && unit != 4) return false;
  const double most = unit == 3 ? 360 : unit == 2 ? 360.0 * 3600 : 3600000;
  if (scan.largest <= most) return true;
  report.warnings.push_back(fmt::format(
      "the coordinate unit {} says angles, but values up to {} are none: they are read as lengths", unit,
      scan.largest));
  return false;
}

void set_local_grid(const std::string& why, survey::Geometry& geometry, Report& report) {
  geometry.map = {};
  geometry.assumed.push_back(why + ": a local grid is used, one unit between neighbouring lines");
  report.residual = std::numeric_limits<double>::quiet_NaN();
}

void check_zeros(const HeaderScan& scan, const MapFit& fit, double bin, Report& report) {
  report.without_coordinates = scan.at_zero.count;
  if (scan.at_zero.count == 0) return;
  // Position (0, 0) is real where the fitted map passes near it.
  const Moments& zero = scan.at_zero;
  const double n = static_cast<double>(zero.count);
  const double du = zero.u0 + static_cast<double>(zero.u) / n - fit.u0;
  const double dv = zero.v0 + static_cast<double>(zero.v) / n - fit.v0;
  const double x = fit.origin_x + fit.per_u_x * du + fit.per_v_x * dv;
  const double y = fit.origin_y + fit.per_u_y * du + fit.per_v_y * dv;
  if (zero.count == 1 && std::hypot(x, y) < 0.5 * bin) {
    report.without_coordinates = 0;
    return;
  }
  report.warnings.push_back(
      fmt::format("{} traces have X and Y zero and are left out of the fit of the map", zero.count));
}

void set_map(const HeaderScan& scan, survey::Geometry& geometry, Report& report) {
  survey::MapView& map = geometry.map;
  if (scan.positions.count == 0 && scan.largest == 0) {
    return set_local_grid("the traces have no X and Y coordinates", geometry, report);
  }
  if (coordinates_are_angles(scan, report)) {
    return set_local_grid("X and Y are angles, which are not read", geometry, report);
  }
  const MapFit fit = fit_map(scan.positions);
  if (fit.kind == MapFit::Kind::kUnusable) {
    return set_local_grid("the X and Y coordinates do not spread as the lines do", geometry, report);
  }
  const double inline_step = geometry.inlines.step;
  const double crossline_step = geometry.crosslines.step;
  map.per_inline_x = fit.per_u_x * inline_step;
  map.per_inline_y = fit.per_u_y * inline_step;
  map.per_crossline_x = fit.per_v_x * crossline_step;
  map.per_crossline_y = fit.per_v_y * crossline_step;
  switch (fit.kind) {
    case MapFit::Kind::kInline:
      map.per_inline_x = -map.per_crossline_y;
      map.per_inline_y = map.per_crossline_x;
      geometry.assumed.emplace_back(
          "one inline only: the next is assumed at right angles, as far off as the traces are");
      break;
    case MapFit::Kind::kCrossline:
      map.per_crossline_x = map.per_inline_y;
      map.per_crossline_y = -map.per_inline_x;
      geometry.assumed.emplace_back(
          "one crossline only: the next is assumed at right angles, as far off as the traces are");
      break;
    case MapFit::Kind::kPoint:
      if (geometry.inlines.count * geometry.crosslines.count > 1) {
        return set_local_grid("only one trace has X and Y coordinates", geometry, report);
      }
      map = {};
      geometry.assumed.emplace_back("one trace only: inlines are assumed to run east, one unit apart");
      break;
    default:
      break;
  }
  const double to_first_u = geometry.inlines.first - fit.u0;
  const double to_first_v = geometry.crosslines.first - fit.v0;
  map.origin_x = fit.origin_x + fit.per_u_x * to_first_u + fit.per_v_x * to_first_v;
  map.origin_y = fit.origin_y + fit.per_u_y * to_first_u + fit.per_v_y * to_first_v;
  report.residual = fit.residual;
  const double bin = std::min(std::hypot(map.per_inline_x, map.per_inline_y),
                              std::hypot(map.per_crossline_x, map.per_crossline_y));
  check_zeros(scan, fit, bin, report);
  if (fit.residual > 0.1 * bin) {
    report.warnings.push_back(
        fmt::format("the traces lie {:.3g} off a regular grid (root mean square), its bins are {:.3g} wide: "
                    "are the coordinates at "
                    "the right bytes?",
                    fit.residual, bin));
  }
}

void set_samples(const Layout& layout, const Options& options, const HeaderScan& scan,
                 survey::Geometry& geometry, Report& report) {
  const double of_traces = scan.interval_us.stated ? scan.interval_us.value : 0;
  report.interval_us = layout.interval_us > 0 ? layout.interval_us : std::max(of_traces, 0.0);
  if (layout.interval_us > 0 && scan.interval_us.stated && of_traces != layout.interval_us) {
    report.warnings.push_back(fmt::format(
        "the sample interval is {} in the binary header and {} in the traces: {}", layout.interval_us,
        of_traces, options.interval ? "the given one is used" : "the first is used"));
  } else if (layout.interval_us <= 0 && of_traces > 0) {
    report.warnings.push_back(
        fmt::format("the binary header has no sample interval: the traces' {} is used", of_traces));
  }
  geometry.interval = options.interval ? *options.interval : report.interval_us / 1000;
  if (!(geometry.interval > 0) || !std::isfinite(geometry.interval)) {
    throw Error(ErrorCode::kFormat, "the headers have no usable sample interval",
                "give it, in the vertical unit");
  }
  geometry.samples = layout.samples;
  geometry.z0 = scan.delay_ms.value;
  if (geometry.z0 != 0 && options.domain == survey::Domain::kDepth) {
    geometry.assumed.push_back(fmt::format("the delay of {} is the depth of the first sample", geometry.z0));
  }
  if (scan.delay_ms.differing > 0) {
    report.warnings.push_back(
        fmt::format("{} traces start elsewhere ({}) than the first ({}), which is used for all",
                    scan.delay_ms.differing, scan.delay_ms.other, scan.delay_ms.value));
  }
  if (scan.samples.stated && (scan.samples.value != layout.samples || scan.samples.differing > 0)) {
    report.warnings.push_back(fmt::format(
        "trace headers say other numbers of samples ({}) than is used ({})",
        scan.samples.value != layout.samples ? scan.samples.value : scan.samples.other, layout.samples));
  }
}

}  // namespace

survey::Geometry make_geometry(const detail::ReadOnlyFile& file, const Layout& layout, const Options& options,
                               const HeaderBytes& at, HeaderScan& scan, Report& report) {
  survey::Geometry geometry;
  geometry.domain = options.domain;
  geometry.vertical_unit = options.vertical_unit;
  geometry.crs = options.crs;
  geometry.horizontal_unit = layout.measurement == 2 ? "ft" : "m";
  if (layout.measurement != 1 && layout.measurement != 2) {
    geometry.assumed.emplace_back("X and Y are in metres: the binary header does not say");
  }
  report.dead_traces = scan.dead;
  settle(file, layout, at, scan, report);
  set_lines(scan, at, geometry);
  scan.index.drop_dead();
  report.live_traces = static_cast<std::int64_t>(scan.index.entries().size());
  report.missing_bins = geometry.inlines.count * geometry.crosslines.count - report.live_traces;
  set_samples(layout, options, scan, geometry, report);
  set_map(scan, geometry, report);
  report.right_handed = geometry.map.per_inline_x * geometry.map.per_crossline_y <
                        geometry.map.per_inline_y * geometry.map.per_crossline_x;
  geometry.validate();
  return geometry;
}

}  // namespace footwall::formats::segy
