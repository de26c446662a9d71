// The way from a file to its survey: layout, choice of header bytes, header pass, geometry. `info` needs it
// step by step, so that a file that import refuses still has its report.
#pragma once
#include <optional>

#include "storage/base/error.h"
#include "storage/formats/segy/candidates.h"
#include "storage/formats/segy/header_scan.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::formats::segy {

struct SurveyScan {
  Layout layout;
  Report report;
  survey::Geometry geometry;
  TraceIndex index;  // settled: one live trace a bin
  std::vector<LineCandidate> candidates;
  bool has_lines = false;  // geometry's inlines and crosslines are known, even where the rest is not
};

// Fills `scan` as far as it comes, then throws what SegyFile::scan says. list_candidates: fill `candidates`
// also where they are not needed.
void scan_survey(const detail::ReadOnlyFile& file, const Options& options, bool list_candidates,
                 const JobContext& job, SurveyScan& scan);

// For `info`: nothing but kNotFound, kIo, kUsage and kCancelled is thrown; why the file cannot be imported is
// in `refusal`.
struct Inspection {
  Report report;
  std::optional<survey::LineAxis> inlines, crosslines;
  std::optional<survey::Geometry> geometry;  // where the file can be imported
  std::vector<LineCandidate> candidates;     // best first
  std::optional<Error> refusal;
};
Inspection inspect(const std::filesystem::path& path, const Options& options, const JobContext& job);

}  // namespace footwall::formats::segy
