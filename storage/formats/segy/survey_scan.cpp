#include "storage/formats/segy/survey_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "storage/formats/segy/presets.h"
#include "storage/formats/segy/survey_grid.h"

namespace footwall::formats::segy {
namespace {

// Coordinates of the additional trace header, in double.
constexpr HeaderWord kExtensionX{static_cast<int>(kTraceHeaderBytes) + 161, WordType::kFloat64};
constexpr HeaderWord kExtensionY{static_cast<int>(kTraceHeaderBytes) + 169, WordType::kFloat64};

bool first_trace_has(const detail::ReadOnlyFile& file, const Layout& layout, const HeaderWord& word) {
  std::array<std::byte, kMostHeaderBytes> header;
  const auto bytes = std::span(header).first(static_cast<std::size_t>(layout.header_bytes()));
  file.read_at(layout.offset_of(0), bytes);
  const double value = value_of(word, bytes, layout.swap, 0);
  return std::isfinite(value) && value != 0;
}

std::string words_text(const HeaderBytes& at) {
  return fmt::format("inline {}, crossline {}, X {}, Y {}", text_of(at.inline_number),
                     text_of(at.crossline_number), text_of(at.x), text_of(at.y));
}

// Where the words are, before any doubt: as given, else by the preset, the file's own stanza, the standard.
HeaderBytes chosen_bytes(const detail::ReadOnlyFile& file, const Layout& layout, const Options& options,
                         std::vector<std::string>& assumed) {
  HeaderBytes at;
  if (!options.preset.empty()) {
    const Preset& preset = preset_named(options.preset);
    at = {preset.inline_word, preset.crossline_word, preset.x, preset.y, at.offset, {}};
  } else if (layout.stanza) {
    const LayoutStanza& stanza = *layout.stanza;
    const HeaderBytes standard = at;
    at.inline_number = stanza.inline_word.value_or(kNoWord);
    at.crossline_number = stanza.crossline_word.value_or(kNoWord);
    at.x = stanza.x.value_or(kNoWord);
    at.y = stanza.y.value_or(kNoWord);
    at.offset = stanza.offset.value_or(kNoWord);
    if (at.inline_number != standard.inline_number || at.crossline_number != standard.crossline_number ||
        at.x != standard.x || at.y != standard.y) {
      assumed.push_back(fmt::format("the file's own layout stanza holds: {}", words_text(at)));
    }
  } else if (layout.has_extension &&
             (first_trace_has(file, layout, kExtensionX) || first_trace_has(file, layout, kExtensionY))) {
    at.x = kExtensionX;
    at.y = kExtensionY;
  }
  if (options.inline_byte) at.inline_number = *options.inline_byte;
  if (options.crossline_byte) at.crossline_number = *options.crossline_byte;
  if (options.x_byte) at.x = *options.x_byte;
  if (options.y_byte) at.y = *options.y_byte;
  at.coordinate_scalar = options.coordinate_scalar;
  return at;
}

// The header pass and the survey's lines.
HeaderScan scan_lines(const detail::ReadOnlyFile& file, HeaderBytes& at, const JobContext& job,
                      SurveyScan& scan) {
  Report& report = scan.report;
  report.inline_word = at.inline_number;
  report.crossline_word = at.crossline_number;
  report.x_word = at.x;
  report.y_word = at.y;
  HeaderScan headers = scan_headers(file, scan.layout, at, report, job);
  const Scalars scalars = headers.scalars;
  if (!at.coordinate_scalar && (is_scaled(at.x.type) || is_scaled(at.y.type)) &&
      scalars_are_doubtful(headers)) {
    HeaderBytes common = at;
    common.coordinate_scalar = scalars.most_common();
    Report again = report;
    headers = {};  // its memory first
    headers = scan_headers(file, scan.layout, common, again, job);
    if (lies_on_grid(headers)) {
      at = common;
      report.warnings.push_back(fmt::format(
          "the traces' coordinate scalars differ, and only one of them makes a grid: {} is used for "
          "all",
          *at.coordinate_scalar));
    } else {
      headers = scan_headers(file, scan.layout, at, again, job);
    }
  }
  report.coordinate_scalar = at.coordinate_scalar.value_or(scalars.most_common());
  report.x_y_scaled = at.coordinate_scalar || is_scaled(at.x.type);
  set_lines(file, scan.layout, at, headers, scan.geometry, report);
  scan.has_lines = true;
  return headers;
}

std::string options_of(const LineCandidate& candidate) {
  return candidate.preset.empty()
             ? fmt::format("--inline-byte {} --crossline-byte {}", text_of(candidate.inline_word),
                           text_of(candidate.crossline_word))
             : "--preset " + candidate.preset;
}

[[noreturn]] void refuse_with_candidates(const Error& refusal, const std::vector<LineCandidate>& candidates) {
  if (candidates.empty()) {
    throw Error(refusal.code(), refusal.message(),
                refusal.hint() + ". No other words of the trace headers make a grid either");
  }
  std::string hint = "line numbers may stand elsewhere, try ";
  for (std::size_t n = 0; n < std::min<std::size_t>(candidates.size(), 3); ++n) {
    hint += fmt::format("{}{} ({} x {} lines)", n > 0 ? ", or " : "", options_of(candidates[n]),
                        candidates[n].inlines, candidates[n].crosslines);
  }
  throw Error(refusal.code(), refusal.message(), hint + "; footwall info shows how well each fits");
}

}  // namespace

void scan_survey(const detail::ReadOnlyFile& file, const Options& options, bool list_candidates,
                 const JobContext& job, SurveyScan& scan) {
  // 1. How the file is laid out, and where the words should be.
  scan.layout = read_layout(file, options, scan.report);
  std::vector<std::string> assumed;
  HeaderBytes at = chosen_bytes(file, scan.layout, options, assumed);
  check_fits(at, scan.layout.header_bytes());
  if (list_candidates) scan.candidates = find_candidates(file, scan.layout);

  // 2. The header pass; where the usual words make no grid, with those that do.
  const bool may_look_elsewhere = options.preset.empty() && !options.inline_byte && !options.crossline_byte;
  const Report before = scan.report;
  HeaderScan headers;
  try {
    headers = scan_lines(file, at, job, scan);
  } catch (const Error& refusal) {
    const bool no_grid = refusal.code() == ErrorCode::kInvalid || refusal.code() == ErrorCode::kUnsupported;
    if (!may_look_elsewhere || !no_grid) throw;
    if (!list_candidates) scan.candidates = find_candidates(file, scan.layout);
    const auto found = beyond_doubt(scan.candidates);
    if (!found && refusal.code() == ErrorCode::kUnsupported) throw;  // prestack: no pair of words mends that
    if (!found) refuse_with_candidates(refusal, scan.candidates);
    at.inline_number = found->inline_word;
    at.crossline_number = found->crossline_word;
    if (!options.x_byte && !options.y_byte && found->x != kNoWord) {
      at.x = found->x;
      at.y = found->y;
    }
    assumed = {fmt::format("line numbers and coordinates are at {}{}: the usual words make no grid, these do",
                           words_text(at), found->preset.empty() ? "" : " (preset " + found->preset + ")")};
    scan.report = before;
    scan.geometry = {};
    headers = scan_lines(file, at, job, scan);
  }

  // 3. The map and the samples.
  scan.geometry.assumed = std::move(assumed);
  set_map_and_samples(scan.layout, options, headers, scan.geometry, scan.report);
  scan.index = std::move(headers.index);
}

Inspection inspect(const std::filesystem::path& path, const Options& options, const JobContext& job) {
  const detail::ReadOnlyFile file(path);
  SurveyScan scan;
  Inspection found;
  try {
    scan_survey(file, options, true, job, scan);
    found.geometry = std::move(scan.geometry);
  } catch (const Error& error) {
    const ErrorCode code = error.code();
    if (code == ErrorCode::kUsage || code == ErrorCode::kIo || code == ErrorCode::kCancelled) throw;
    found.refusal = error;
  }
  if (scan.has_lines) {
    const survey::Geometry& geometry = found.geometry ? *found.geometry : scan.geometry;
    found.inlines = geometry.inlines;
    found.crosslines = geometry.crosslines;
  }
  found.report = std::move(scan.report);
  found.candidates = std::move(scan.candidates);
  return found;
}

}  // namespace footwall::formats::segy
