#include "engine/tasks/bench_topology.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <optional>
#include <random>

#include "engine/isosurface/grid_topology.h"
#include "engine/isosurface/seed_tables.h"
#include "engine/verify/trilinear_level_set.h"
#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

constexpr std::int64_t kMostSamples = 64;  // along an axis

// What stands in the columns: the place of a value, or a name.
struct Column {
  std::optional<std::size_t> value;
  std::string name;
};

struct Heading {
  std::vector<Column> columns;
  std::int64_t samples = 0;  // along an axis
};

Error wrong(const std::filesystem::path& path, std::int64_t line, const std::string& what,
            const std::string& hint = {}) {
  return {ErrorCode::kFormat, fmt::format("{}, line {}: {}", path.string(), line, what), hint};
}

// "v12" is value 12.
std::optional<std::int64_t> value_number(std::string_view word) {
  if (word.size() < 2 || word[0] != 'v') return std::nullopt;
  const auto number = text::integer(word.substr(1));
  return number && *number >= 0 && *number < kMostSamples * kMostSamples * kMostSamples ? number
                                                                                        : std::nullopt;
}

Heading heading_of(std::string_view row, const std::filesystem::path& path, std::int64_t line) {
  Heading heading;
  std::int64_t values = 0;
  for (const std::string_view word : text::split(row, ',')) {
    const std::size_t dots = word.find("..");
    const auto first = value_number(word.substr(0, dots));
    const auto last = dots == std::string_view::npos ? first : value_number(word.substr(dots + 2));
    if (!first || !last) {
      if (word != "id" && word != "chi" && word != "b0" && word != "genus")
        throw wrong(path, line, fmt::format("no column is called '{}'", word.substr(0, 40)),
                    "use id, chi, b0, genus, v0, v1, ... or v0..v124");
      heading.columns.push_back({std::nullopt, std::string(word)});
      continue;
    }
    for (std::int64_t n = *first; n <= *last; ++n) {
      if (n != values++) throw wrong(path, line, "the values are not numbered v0, v1, v2, ...");
      heading.columns.push_back({static_cast<std::size_t>(n), {}});
    }
  }
  while (heading.samples * heading.samples * heading.samples < values) ++heading.samples;
  if (heading.samples < 2 || heading.samples * heading.samples * heading.samples != values)
    throw wrong(path, line, fmt::format("{} values are no cube of samples", values),
                "8 values are a cell, 125 a grid of 5 x 5 x 5");
  return heading;
}

struct Row {
  std::string id;
  std::vector<float> values;
  std::map<std::string, std::int64_t> expected;
};

Row row_of(std::string_view text_row, const Heading& heading, const std::filesystem::path& path,
           std::int64_t line) {
  const std::vector<std::string_view> fields = text::split(text_row, ',');
  if (fields.size() != heading.columns.size())
    throw wrong(path, line, fmt::format("{} fields instead of {}", fields.size(), heading.columns.size()));
  Row row;
  row.id = std::to_string(line);
  for (std::size_t n = 0; n < fields.size(); ++n) {
    const Column& column = heading.columns[n];
    if (column.value) {
      const auto number = text::number(fields[n]);
      if (!number || !std::isfinite(static_cast<float>(*number)))
        throw wrong(path, line, fmt::format("'{}' is no sample", fields[n].substr(0, 40)));
      row.values.push_back(static_cast<float>(*number));
    } else if (column.name == "id") {
      row.id = fields[n];
    } else {
      const auto number = text::integer(fields[n]);
      if (!number)
        throw wrong(path, line,
                    fmt::format("{} is no whole number: '{}'", column.name, fields[n].substr(0, 40)));
      row.expected[column.name == "chi" ? "euler" : column.name == "b0" ? "components" : "genus"] = *number;
    }
  }
  // Handles are counted of closed surfaces.
  if (row.expected.count("genus") != 0) row.expected["boundary_edges"] = 0;
  return row;
}

void compare(const Row& row, const isosurface::SurfaceForm& form, BenchTopologyResult& result) {
  const std::map<std::string, std::int64_t> found{{"euler", form.euler},
                                                  {"components", form.components},
                                                  {"genus", form.genus},
                                                  {"boundary_edges", form.border_edges + form.open_edges}};
  TopologyMismatch mismatch;
  for (const auto& [name, expected] : row.expected) {
    if (found.at(name) == expected) continue;
    mismatch.expected[name] = expected;
    mismatch.got[name] = found.at(name);
  }
  ++result.rows;
  result.triangles += form.triangles;
  result.open_edges += form.open_edges;
  result.crowded_edges += form.crowded_edges;
  if (mismatch.expected.empty()) return;
  mismatch.id = row.id;
  result.mismatches.push_back(std::move(mismatch));
}

void read_rows(const BenchTopologyOptions& options, const isosurface::CaseRules& rules, const JobContext& job,
               BenchTopologyResult& result) {
  std::ifstream in(options.csv);
  if (!in) throw io_error("open", options.csv.string(), errno);
  std::optional<Heading> heading;
  std::int64_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string_view row_text = text::trimmed(line);
    if (row_text.empty() || row_text.front() == '#') continue;
    if (!heading) {
      heading = heading_of(row_text, options.csv, number);
      continue;
    }
    if (number % 64 == 0) job.check();
    const Row row = row_of(row_text, *heading, options.csv, number);
    const survey::Index size{heading->samples, heading->samples, heading->samples};
    const isosurface::Field field{row.values, size, {0, 0, 0}, size};
    const auto triangles = isosurface::triangles_by_cell(field, options.isovalue, rules);
    compare(row, isosurface::form_of(triangles, size), result);
  }
  if (in.bad()) throw io_error("read", options.csv.string(), errno);
  if (!heading) throw wrong(options.csv, number, "no heading", "begin with id,v0,...,v7,chi");
}

// Whole numbers, so that the samples of the field are exact; every sign case in turn, and of sizes from equal
// to very different: tunnels are more frequent then.
std::array<float, 8> random_cell(unsigned signs, std::mt19937_64& random) {
  const auto most = static_cast<unsigned>(1 + random() % 10);
  std::array<float, 8> values{};
  for (unsigned c = 0; c < 8; ++c) {
    const auto size = static_cast<float>(random() % (std::uint64_t{1} << (1 + random() % most)));
    values[c] = (signs >> c & 1U) != 0 ? size : -1 - size;
  }
  return values;
}

void compare_cells(const BenchTopologyOptions& options, const isosurface::CaseRules& rules,
                   const JobContext& job, BenchTopologyResult& result) {
  std::mt19937_64 random(options.seed);
  const survey::Index size{2, 2, 2};
  for (std::int64_t n = 0; n < options.cells; ++n) {
    if (n % 4096 == 0)
      job.report(static_cast<double>(n) / static_cast<double>(options.cells), "compare cells");
    const std::array<float, 8> values = random_cell(static_cast<unsigned>(n % 256), random);
    std::array<double, 8> exact{};  // x fastest, as its corners are numbered
    std::array<float, 8> samples{};
    for (unsigned c = 0; c < 8; ++c) {
      exact[c] = values[c];
      samples[(c & 1U) << 2 | (c & 2U) | c >> 2] = values[c];
    }
    ++result.cells;
    const std::optional<int> euler = verify::trilinear_euler_number(exact);
    if (!euler) {
      ++result.cells_undecided;
      continue;
    }
    const isosurface::Field field{samples, size, {0, 0, 0}, size};
    const auto form = isosurface::form_of(isosurface::triangles_by_cell(field, 0, rules), size);
    result.cell_mismatches += form.euler != *euler ? 1 : 0;
  }
}

}  // namespace

BenchTopologyResult bench_topology(const BenchTopologyOptions& options, const JobContext& job) {
  const isosurface::CaseRules& rules = isosurface::rules_of(options.tables);
  if (!std::isfinite(options.isovalue))
    throw Error(ErrorCode::kUsage, "the isovalue is not finite", "give a number");
  if (options.cells < 0 || (options.cells == 0 && options.csv.empty()))
    throw Error(ErrorCode::kUsage, "nothing to compare",
                "give --csv FILE, or --cells with a number from 1 on");
  BenchTopologyResult result;
  if (!options.csv.empty()) read_rows(options, rules, job, result);
  compare_cells(options, rules, job, result);
  return result;
}

}  // namespace footwall::tasks
