#include "app/footwall/commands/segy_info.h"

#include <fmt/format.h>

#include <cmath>

#include "storage/formats/segy/survey_scan.h"
#include "storage/survey/units.h"

namespace footwall::commands {
namespace {

using console::Json;
using formats::segy::Inspection;
using formats::segy::LineCandidate;
using formats::segy::Report;
using formats::segy::text_of;

Json axis_json(const std::optional<survey::LineAxis>& axis) {
  if (!axis) return nullptr;
  return {{"first", axis->first}, {"last", axis->last()}, {"step", axis->step}, {"count", axis->count}};
}

Json gaps_json(const Report& report) {
  Json listed = Json::array();
  for (const formats::segy::LineGap& gap : report.gaps.listed) {
    listed.push_back({{"inline", gap.line},
                      {"missing", gap.missing},
                      {"first_crossline", gap.first},
                      {"last_crossline", gap.last}});
  }
  return {{"missing_bins", report.missing_bins},
          {"inlines_with_gaps", report.gaps.lines},
          {"inlines_missing", report.gaps.whole_lines},
          {"inlines", listed}};
}

Json conflicts_json(const Report& report) {
  Json rows = Json::array();
  for (const formats::segy::Conflict& conflict : report.conflicts) {
    rows.push_back({{"what", conflict.what},
                    {"stated", conflict.binary_header},
                    {"trace_headers", conflict.trace_headers},
                    {"traces", conflict.traces},
                    {"used", conflict.used}});
  }
  return rows;
}

Json candidates_json(const std::vector<LineCandidate>& candidates) {
  Json rows = Json::array();
  for (const LineCandidate& candidate : candidates) {
    rows.push_back({{"inline_byte", text_of(candidate.inline_word)},
                    {"crossline_byte", text_of(candidate.crossline_word)},
                    {"x_byte", text_of(candidate.x)},
                    {"y_byte", text_of(candidate.y)},
                    {"preset", candidate.preset.empty() ? Json() : Json(candidate.preset)},
                    {"inlines", candidate.inlines},
                    {"crosslines", candidate.crosslines},
                    {"hits", candidate.hits},
                    {"fill", candidate.fill},
                    {"misfit_bins", candidate.misfit},
                    {"score", candidate.score}});
  }
  return rows;
}

Json unless_unknown(std::int64_t number, bool known) {
  return known ? Json(number) : Json();
}

// False where the file was refused before its trace headers were read.
bool has_header_bytes(const Report& report) {
  return report.inline_word != formats::segy::HeaderWord();
}

Json bytes_json(const Report& report) {
  if (!has_header_bytes(report)) return nullptr;
  return {{"inline", text_of(report.inline_word)},
          {"crossline", text_of(report.crossline_word)},
          {"x", text_of(report.x_word)},
          {"y", text_of(report.y_word)}};
}

Json segy_json(const Inspection& found) {
  const Report& report = found.report;
  const double metres = report.horizontal_unit == "ft" ? survey::kMetresPerFoot : 1;
  const bool lines = found.inlines.has_value();
  const bool mapped = std::isfinite(report.residual);
  Json facts = {
      {"format", report.format},
      {"format_name", report.format_name.empty() ? Json() : Json(report.format_name)},
      {"endian", formats::segy::name_of(report.endian)},
      {"revision", fmt::format("{}.{}", report.revision_major, report.revision_minor)},
      {"text_encoding", report.text_is_ebcdic ? "EBCDIC" : "ASCII"},
      {"traces", report.traces},
      {"samples", report.samples},
      {"interval_us", report.interval_us > 0 ? Json(report.interval_us) : Json()},
      {"inlines", axis_json(found.inlines)},
      {"crosslines", axis_json(found.crosslines)},
      {"live_traces", unless_unknown(report.live_traces, lines)},
      {"dead_traces", unless_unknown(report.dead_traces, lines)},
      {"duplicates", unless_unknown(report.duplicates, lines)},
      {"odd_traces", unless_unknown(report.odd_traces, lines)},
      {"missing_bins", unless_unknown(report.missing_bins, lines)},
      {"gaps", lines ? gaps_json(report) : Json()},
      {"first_sample", found.geometry ? Json(found.geometry->z0) : Json()},
      {"domain", nullptr},
      {"vertical_unit", nullptr},
      {"crs", nullptr},
      {"horizontal_unit", report.horizontal_unit.empty() ? Json() : Json(report.horizontal_unit)},
      {"bytes", bytes_json(report)},
      {"coordinate_scalar", report.x_y_scaled ? Json(report.coordinate_scalar) : Json()},
      {"without_coordinates", unless_unknown(report.without_coordinates, lines)},
      {"residual_m", report.residual * metres},
      {"largest_residual_m", report.largest_residual * metres},
      {"handedness", mapped ? Json(report.right_handed ? "right" : "left") : Json()},
      {"conflicts", conflicts_json(report)},
      {"candidates", candidates_json(found.candidates)},
      {"assumed", found.geometry ? Json(found.geometry->assumed) : Json::array()},
      {"warnings", report.warnings},
      {"importable", !found.refusal},
      {"reason", found.refusal ? Json(found.refusal->message()) : Json()},
      {"hint", found.refusal ? Json(found.refusal->hint()) : Json()},
      {"text_header", report.text_header},
      {"extended_text_header", report.extended_text_header},
  };
  return facts;
}

std::string row(std::string_view name, const std::string& value) {
  return fmt::format("{:<15}{}\n", name, value);
}

std::string axis_text(const std::optional<survey::LineAxis>& axis) {
  if (!axis) return "not known";
  return fmt::format("{} to {} by {} ({})", axis->first, axis->last(), axis->step, axis->count);
}

std::string traces_text(const Inspection& found) {
  const Report& report = found.report;
  std::string text = row("traces", fmt::format("{} of {} samples", report.traces, report.samples));
  if (!found.inlines) return text;
  text += row("", fmt::format("{} live, {} dead, {} doubled, {} on odd lines", report.live_traces,
                              report.dead_traces, report.duplicates, report.odd_traces));
  const formats::segy::Gaps& gaps = report.gaps;
  text +=
      row("gaps", report.missing_bins == 0
                      ? std::string("none: every bin has a live trace")
                      : fmt::format("{} bins without a live trace: {} inlines with gaps, {} missing whole",
                                    report.missing_bins, gaps.lines, gaps.whole_lines));
  constexpr std::size_t kShown = 10;
  for (std::size_t n = 0; n < std::min(gaps.listed.size(), kShown); ++n) {
    const formats::segy::LineGap& gap = gaps.listed[n];
    text += row("", fmt::format("inline {}: {} missing between crosslines {} and {}", gap.line, gap.missing,
                                gap.first, gap.last));
  }
  if (gaps.lines + gaps.whole_lines > static_cast<std::int64_t>(kShown))
    text += row("", "... --json lists the first 100");
  return text;
}

std::string map_text(const Inspection& found, const Json& facts) {
  const Report& report = found.report;
  if (!has_header_bytes(report)) return {};
  std::string text =
      row("header bytes",
          fmt::format("inline {}, crossline {}, X {}, Y {}{}", text_of(report.inline_word),
                      text_of(report.crossline_word), text_of(report.x_word), text_of(report.y_word),
                      report.x_y_scaled ? fmt::format(", scalar {}", report.coordinate_scalar) : ""));
  if (!std::isfinite(report.residual)) return text;
  text +=
      row("map fit", fmt::format("{:.3g} m root mean square, {:.3g} m at most, {}-handed, X and Y in {}",
                                 facts["residual_m"].get<double>(), facts["largest_residual_m"].get<double>(),
                                 report.right_handed ? "right" : "left", report.horizontal_unit));
  return text;
}

std::string candidates_text(const std::vector<LineCandidate>& candidates) {
  if (candidates.empty()) return row("candidates", "no words of the trace headers make a grid");
  std::string text = fmt::format("\n{:<14}{:<14}{:>9}{:>12}{:>7}{:>7}{:>9}{:>7}  {:<20}{}\n", "inline byte",
                                 "crossline byte", "inlines", "crosslines", "hits", "fill", "misfit", "score",
                                 "X, Y", "preset");
  for (const LineCandidate& one : candidates) {
    text +=
        fmt::format("{:<14}{:<14}{:>9}{:>12}{:>7.2f}{:>7.2f}{:>9}{:>7.2f}  {:<20}{}\n",
                    text_of(one.inline_word), text_of(one.crossline_word), one.inlines, one.crosslines,
                    one.hits, one.fill, std::isfinite(one.misfit) ? fmt::format("{:.2g}", one.misfit) : "-",
                    one.score, fmt::format("{}, {}", text_of(one.x), text_of(one.y)), one.preset);
  }
  return text +
         "(hits: neighbours in the file that are neighbours on a line; fill: traces a bin; misfit: of X, Y, "
         "in bins)\n\n";
}

// Lines of a text header are often numbered and nothing more: "C12".
bool says_something(std::string_view line) {
  return line.find_first_not_of(" 0123456789", line.starts_with('C') ? 1 : 0) != std::string_view::npos;
}

std::string segy_text(const Inspection& found, const Json& facts) {
  const Report& report = found.report;
  std::string text = row(
      "format", fmt::format("{} {}, {}-endian, revision {}.{}, text in {}", report.format, report.format_name,
                            formats::segy::name_of(report.endian), report.revision_major,
                            report.revision_minor, facts["text_encoding"].get<std::string>()));
  text += row("interval", report.interval_us > 0
                              ? fmt::format("{} us (or thousandths of a metre or foot)", report.interval_us)
                              : std::string("not stated"));
  text += row("domain", "not stated by SEG-Y: --domain and --vertical-unit tell import");
  text += row("inlines", axis_text(found.inlines)) + row("crosslines", axis_text(found.crosslines));
  text += traces_text(found) + map_text(found, facts);
  if (has_header_bytes(report)) text += candidates_text(found.candidates);
  for (const formats::segy::Conflict& conflict : report.conflicts) {
    text += fmt::format("conflict: {} is {} and, in {} trace headers, {}; {} is used\n", conflict.what,
                        conflict.binary_header, conflict.traces, conflict.trace_headers, conflict.used);
  }
  for (const Json& line : facts["assumed"]) text += fmt::format("assumed: {}\n", line.get<std::string>());
  for (const std::string& warning : report.warnings) text += fmt::format("warning: {}\n", warning);
  if (found.refusal) {
    text += fmt::format("cannot be imported: {}\n", found.refusal->message());
    if (!found.refusal->hint().empty()) text += fmt::format("  {}\n", found.refusal->hint());
  }
  text += "\n";
  for (const auto* lines : {&report.text_header, &report.extended_text_header}) {
    for (const std::string& line : *lines) {
      if (says_something(line)) text += line + "\n";
    }
  }
  return text;
}

}  // namespace

console::Output segy_info(const std::string& file, const SegyOptions& options,
                          const console::Console& console) {
  // Only headers are reported, which read the same whatever z means.
  const Inspection found = formats::segy::inspect(file, options.to_options(), console.job());
  console::Output output;
  output.json = segy_json(found);
  output.text = segy_text(found, output.json);
  return output;
}

}  // namespace footwall::commands
