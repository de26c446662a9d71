#include "storage/formats/segy/survey_grid.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "storage/base/error.h"
#include "storage/formats/segy/line_steps.h"
#include "storage/formats/segy/stray_positions.h"

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kMostChecked = 4096;  // duplicates whose offsets are looked up

[[noreturn]] void refuse_lines(const HeaderBytes& at, const std::string& what) {
  throw Error(ErrorCode::kInvalid,
              fmt::format("{} (inline numbers read at byte {}, crossline numbers at byte {})", what,
                          text_of(at.inline_number), text_of(at.crossline_number)),
              "line numbers may stand elsewhere in the trace headers: see the candidates that footwall info "
              "lists, and "
              "give --preset, or --inline-byte and --crossline-byte");
}

double offset_word(const detail::ReadOnlyFile& file, const Layout& layout, const HeaderBytes& at,
                   std::int64_t trace) {
  std::array<std::byte, kMostHeaderBytes> header;
  const auto bytes = std::span(header).first(static_cast<std::size_t>(layout.header_bytes()));
  file.read_at(layout.offset_of(trace), bytes);
  return read_trace_header(bytes, at, layout.swap, trace).offset;
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
    if (offset_word(file, layout, at, first.trace()) != offset_word(file, layout, at, again.trace()))
      ++differing;
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

survey::LineAxis axis_of(const LineSteps& steps, std::string_view what, const HeaderBytes& at) {
  constexpr std::int64_t kMostLines = std::int64_t{1} << 23;
  if (steps.count() > kMostLines || steps.step > std::numeric_limits<std::int32_t>::max()) {
    refuse_lines(at, fmt::format("{} numbers from {} to {} in steps of {} make no survey", what, steps.lowest,
                                 steps.highest, steps.step));
  }
  return {static_cast<std::int32_t>(steps.lowest), static_cast<std::int32_t>(steps.step), steps.count()};
}

struct Steps {
  LineSteps inlines, crosslines;
  // As a double: two axes of 2^32 lines have more bins than 64 bits count.
  double bins() const {
    return static_cast<double>(inlines.count()) * static_cast<double>(crosslines.count());
  }
};

Steps steps_of_all(const TraceIndex& index) {
  StepsSoFar inlines, crosslines;
  for (const IndexEntry& entry : index.entries()) {
    inlines.add(entry.inline_number);
    crosslines.add(entry.crossline_number);
  }
  return {inlines.steps(), crosslines.steps()};
}

// Needs 4 bytes a trace for a while, but only where the grid is suspect.
Steps main_steps_of_all(const TraceIndex& index) {
  std::vector<std::int32_t> lines;
  lines.reserve(index.entries().size());
  for (const IndexEntry& entry : index.entries()) lines.push_back(entry.inline_number);
  Steps steps;
  steps.inlines = main_steps_of(lines);
  lines.clear();
  for (const IndexEntry& entry : index.entries()) lines.push_back(entry.crossline_number);
  std::sort(lines.begin(), lines.end());
  steps.crosslines = main_steps_of(lines);
  return steps;
}

// One odd line number must not blow up the grid: a few traces off the grid of all others are left out.
void leave_out_odd(HeaderScan& scan, const Steps& main, Report& report) {
  std::string examples;
  std::int64_t odd = 0;
  scan.index.erase_if([&](const IndexEntry& entry) {
    if (main.inlines.has(entry.inline_number) && main.crosslines.has(entry.crossline_number)) return false;
    constexpr std::int64_t kNamed = 3;
    if (odd < kNamed) {
      examples += fmt::format("{}inline {} crossline {}", odd > 0 ? ", " : "", entry.inline_number,
                              entry.crossline_number);
    }
    ++odd;
    return true;
  });
  report.odd_traces = odd;
  report.warnings.push_back(fmt::format(
      "{} traces whose line numbers lie off the grid of all others are left out ({}{}): inlines are {} to {} "
      "in steps of {}, crosslines {} to {} in steps of {}",
      odd, examples, odd > 3 ? ", ..." : "", main.inlines.lowest, main.inlines.highest, main.inlines.step,
      main.crosslines.lowest, main.crosslines.highest, main.crosslines.step));
}

void set_axes(HeaderScan& scan, const HeaderBytes& at, survey::Geometry& geometry, Report& report) {
  Steps steps = steps_of_all(scan.index);
  const auto traces = static_cast<double>(scan.index.entries().size());
  if (steps.bins() > 1.5 * traces) {
    const Steps main = main_steps_of_all(scan.index);
    if (main.bins() < steps.bins()) {
      leave_out_odd(scan, main, report);
      steps = main;
    }
  }
  geometry.inlines = axis_of(steps.inlines, "inline", at);
  geometry.crosslines = axis_of(steps.crosslines, "crossline", at);
  if (steps.bins() > 100 * traces + 10000) {
    refuse_lines(at, fmt::format("{} traces are strewn over {} x {} lines", traces, geometry.inlines.count,
                                 geometry.crosslines.count));
  }
}

// The index is sorted by inline, then crossline, and has one live trace a bin.
void find_gaps(const HeaderScan& scan, const survey::Geometry& geometry, Report& report) {
  const auto& entries = scan.index.entries();
  const survey::LineAxis& across = geometry.crosslines;
  std::size_t at = 0;
  for (std::int64_t i = 0; i < geometry.inlines.count; ++i) {
    LineGap gap;
    gap.line = geometry.inlines.line_of(i);
    std::int64_t expected = 0, first = -1, last = -1;
    const auto miss_up_to = [&](std::int64_t j) {
      if (j == expected) return;
      if (first < 0) first = expected;
      last = j - 1;
      gap.missing += j - expected;
    };
    for (; at < entries.size() && entries[at].inline_number == gap.line; ++at) {
      const std::int64_t j = across.index_of(entries[at].crossline_number);
      miss_up_to(j);
      expected = j + 1;
    }
    miss_up_to(across.count);
    if (gap.missing == 0) continue;
    ++(gap.missing == across.count ? report.gaps.whole_lines : report.gaps.lines);
    gap.first = across.line_of(first);
    gap.last = across.line_of(last);
    if (report.gaps.listed.size() < Gaps::kListed) report.gaps.listed.push_back(gap);
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

void set_local_grid(const std::string& why, survey::Geometry& geometry) {
  geometry.map = {};
  geometry.assumed.push_back(why + ": a local grid is used, one unit between neighbouring lines");
}

// Of live traces with coordinates, from the map; `scan` keeps where they are relative to the first one.
// Those beyond `farthest` do not count.
double largest_distance(const HeaderScan& scan, const survey::Geometry& geometry, double farthest) {
  const survey::MapView& map = geometry.map;
  double largest = 0;
  for (const IndexEntry& entry : scan.index.entries()) {
    const Offset2 offset = scan.offsets[static_cast<std::size_t>(entry.trace())];
    if (!(std::isfinite(offset.x) && std::isfinite(offset.y))) continue;
    const auto i = static_cast<double>(geometry.inlines.index_of(entry.inline_number));
    const auto j = static_cast<double>(geometry.crosslines.index_of(entry.crossline_number));
    const double x = map.origin_x - scan.positions.x0 + map.per_inline_x * i + map.per_crossline_x * j;
    const double y = map.origin_y - scan.positions.y0 + map.per_inline_y * i + map.per_crossline_y * j;
    const double distance = std::hypot(x - static_cast<double>(offset.x), y - static_cast<double>(offset.y));
    if (distance <= farthest) largest = std::max(largest, distance);
  }
  return largest;
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
    return set_local_grid("the traces have no X and Y coordinates", geometry);
  }
  if (coordinates_are_angles(scan, report)) {
    return set_local_grid("X and Y are angles, which are not read", geometry);
  }
  MapFit fit = fit_map(scan.positions);
  double farthest = std::numeric_limits<double>::infinity();
  if (!(misfit_in_bins(fit) <= 0.1)) {
    if (const auto without = fit_without_strays(scan, fit)) {
      fit = without->fit;
      farthest = without->farthest;
      report.warnings.push_back(fmt::format(
          "the coordinates of {} traces lie far off the grid of all others and are left out of the fit of "
          "the map",
          without->left_out));
    }
  }
  if (fit.kind == MapFit::Kind::kUnusable) {
    return set_local_grid("the X and Y coordinates do not spread as the lines do", geometry);
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
        return set_local_grid("only one trace has X and Y coordinates", geometry);
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
  report.largest_residual = largest_distance(scan, geometry, farthest);
  const double bin = std::min(std::hypot(map.per_inline_x, map.per_inline_y),
                              std::hypot(map.per_crossline_x, map.per_crossline_y));
  check_zeros(scan, fit, bin, report);
  if (fit.residual > 0.1 * bin) {
    report.warnings.push_back(fmt::format(
        "the traces lie {:.3g} {} off a regular grid (root mean square; the farthest {:.3g}), its "
        "bins are {:.3g} wide: are the coordinates at the right bytes?",
        fit.residual, geometry.horizontal_unit, report.largest_residual, bin));
  }
}

void set_interval(const Layout& layout, const Options& options, const HeaderScan& scan,
                  survey::Geometry& geometry, Report& report) {
  const double of_traces = scan.interval_us.stated ? scan.interval_us.value : 0;
  const bool of_binary = layout.interval_us > 0;
  report.interval_us = of_binary ? layout.interval_us : std::max(of_traces, 0.0);
  geometry.interval = options.interval ? *options.interval : report.interval_us / 1000;
  const bool first_differs = scan.interval_us.stated && of_traces != layout.interval_us;
  const std::int64_t differing =
      first_differs ? scan.interval_us.count - scan.interval_us.differing : scan.interval_us.differing;
  if (of_binary && scan.interval_us.stated && differing > 0) {
    const double other = first_differs ? of_traces : scan.interval_us.other;
    report.conflicts.push_back(
        {"sample interval", layout.interval_us, other, differing, geometry.interval * 1000});
    report.warnings.push_back(fmt::format(
        "the sample interval is {} us in the binary header and {} in {} traces: {}", layout.interval_us,
        other, differing, options.interval ? "the given one is used" : "the first is used"));
  } else if (!of_binary && of_traces > 0) {
    report.conflicts.push_back(
        {"sample interval", layout.interval_us, of_traces, scan.live, geometry.interval * 1000});
    report.warnings.push_back(
        fmt::format("the binary header has no sample interval: the traces' {} us is used", of_traces));
  }
}

void check_interval(const HeaderScan& scan, const Report& report, const survey::Geometry& geometry) {
  if (geometry.interval > 0 && std::isfinite(geometry.interval)) return;
  const auto about = std::find_if(report.warnings.begin(), report.warnings.end(), [](const std::string& one) {
    return one.starts_with("the binary header's sample interval");
  });
  const std::string binary = about == report.warnings.end() ? "" : ": " + *about;
  throw Error(ErrorCode::kFormat,
              scan.interval_us.stated && scan.interval_us.value < 0
                  ? fmt::format("no header has a usable sample interval (the traces say {} us)",
                                scan.interval_us.value)
                  : "the headers have no usable sample interval" + binary,
              "give it with --interval, in the vertical unit");
}

void set_samples(const Layout& layout, const Options& options, const HeaderScan& scan,
                 survey::Geometry& geometry, Report& report) {
  set_interval(layout, options, scan, geometry, report);
  geometry.samples = layout.samples;
  geometry.z0 = scan.delay_ms.value;
  if (geometry.z0 != 0 && options.domain == survey::Domain::kDepth) {
    geometry.assumed.push_back(fmt::format("the delay of {} is the depth of the first sample", geometry.z0));
  }
  if (scan.delay_ms.differing > 0) {
    report.conflicts.push_back(
        {"delay", scan.delay_ms.value, scan.delay_ms.other, scan.delay_ms.differing, scan.delay_ms.value});
    report.warnings.push_back(
        fmt::format("{} traces start elsewhere ({}) than the first ({}), which is used for all",
                    scan.delay_ms.differing, scan.delay_ms.other, scan.delay_ms.value));
  }
  const auto samples = static_cast<double>(layout.samples);
  if (scan.samples.stated && (scan.samples.value != samples || scan.samples.differing > 0)) {
    const bool first = scan.samples.value != samples;
    const double other = first ? scan.samples.value : scan.samples.other;
    report.conflicts.push_back({"samples", samples, other,
                                first ? scan.samples.count - scan.samples.differing : scan.samples.differing,
                                samples});
    report.warnings.push_back(fmt::format("trace headers say other numbers of samples ({}) than is used ({})",
                                          other, layout.samples));
  }
  check_interval(scan, report, geometry);
}

}  // namespace

void set_lines(const detail::ReadOnlyFile& file, const Layout& layout, const HeaderBytes& at,
               HeaderScan& scan, survey::Geometry& geometry, Report& report) {
  report.dead_traces = scan.dead;
  settle(file, layout, at, scan, report);
  set_axes(scan, at, geometry, report);
  scan.index.drop_dead();
  report.live_traces = static_cast<std::int64_t>(scan.index.entries().size());
  report.missing_bins = geometry.inlines.count * geometry.crosslines.count - report.live_traces;
  find_gaps(scan, geometry, report);
}

void set_map_and_samples(const Layout& layout, const Options& options, const HeaderScan& scan,
                         survey::Geometry& geometry, Report& report) {
  geometry.domain = options.domain;
  geometry.vertical_unit = options.vertical_unit;
  geometry.crs = options.crs;
  geometry.horizontal_unit = layout.measurement == 2 ? "ft" : "m";
  report.horizontal_unit = geometry.horizontal_unit;
  if (layout.measurement != 1 && layout.measurement != 2) {
    geometry.assumed.emplace_back("X and Y are in metres: the binary header does not say");
  }
  set_map(scan, geometry, report);
  report.right_handed = geometry.map.per_inline_x * geometry.map.per_crossline_y <
                        geometry.map.per_inline_y * geometry.map.per_crossline_x;
  set_samples(layout, options, scan, geometry, report);
  geometry.validate();
}

bool lies_on_grid(const HeaderScan& scan) {
  return misfit_in_bins(fit_map(scan.positions)) <= 0.1;
}

bool scalars_are_doubtful(const HeaderScan& scan) {
  return !scan.scalars.agree() && !lies_on_grid(scan);
}

}  // namespace footwall::formats::segy
