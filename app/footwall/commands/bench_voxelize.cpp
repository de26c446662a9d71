// footwall bench voxelize: triangles of a file, the seed's benchmark, or values gathered on the way.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/bench_gather.h"
#include "engine/tasks/bench_voxelize.h"
#include "engine/tasks/bench_voxelize_table.h"
#include "engine/tasks/detail/voxelize_published.h"
#include "storage/base/error.h"

namespace footwall::commands {
namespace {

using nlohmann::json;

struct Options {
  tasks::BenchVoxelizeOptions file;
  bool table = false;
  std::vector<std::string> vertices;
  std::string gather;
  std::string output = "coordinates";
  std::vector<int> threads = {1};
  std::vector<double> areas;
  std::optional<int> runs;
  bool one_triangle = false;
};

double percent(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

json json_of(const tasks::VoxelDifferences& found) {
  return {{"triangles", found.triangles}, {"exact_voxels", found.exact},
          {"missed", found.missed},       {"missed_percent", percent(found.missed, found.exact)},
          {"extra", found.extra},         {"extra_percent", percent(found.extra, found.exact)},
          {"duplicates", found.repeated}, {"duplicates_percent", percent(found.repeated, found.exact)}};
}

std::string text_of(const tasks::VoxelDifferences& found) {
  return fmt::format(
      "against exact, {} triangles of {} voxels: {} missed ({:.2f} %), {} extra ({:.2f} %), {} duplicates "
      "({:.2f} %)\n",
      found.triangles, found.exact, found.missed, percent(found.missed, found.exact), found.extra,
      percent(found.extra, found.exact), found.repeated, percent(found.repeated, found.exact));
}

console::Output of_file(const tasks::BenchVoxelizeOptions& options, const console::Console& console) {
  const tasks::BenchVoxelizeResult done = tasks::bench_voxelize(options, console.job());
  console::Output output;
  output.json = {{"voxelizer", done.voxelizer},
                 {"simd", done.simd},
                 {"threads", done.threads},
                 {"triangles", done.triangles},
                 {"voxels", done.voxels},
                 {"seconds", done.seconds},
                 {"seconds_min", done.seconds_min},
                 {"seconds_max", done.seconds_max},
                 {"voxels_per_second", done.voxels_per_second},
                 {"checked_triangles", done.check.triangles},
                 {"counts", done.counts}};
  output.text = fmt::format(
      "{:<13} {:<10} {:>7} {:>10} {:>14} {:>12} {:>10} {:>10} {:>12}\n{:<13} {:<10} {:>7} {:>10} {:>14} "
      "{:>12.6f} {:>10.6f} {:>10.6f} {:>12.1f}\n",
      "voxelizer", "simd", "threads", "triangles", "voxels", "median s", "min s", "max s", "M voxels/s",
      done.voxelizer, done.simd, done.threads, done.triangles, done.voxels, done.seconds, done.seconds_min,
      done.seconds_max, done.voxels_per_second / 1e6);
  output.text += fmt::format("{} triangles were compared with the definition first\n", done.check.triangles);
  if (!done.exact) {
    output.json["differences"] = json_of(done.differences);
    output.text += text_of(done.differences);
  }
  return output;
}

json json_of(const tasks::VoxelizeTableRow& row, int triangles) {
  json vertices = json::array();
  for (const survey::IndexPoint& p : row.vertices) vertices.push_back({p.i, p.j, p.k});
  return {{"asked_area", row.asked_area == 0 ? json() : json(row.asked_area)},
          {"vertices", vertices},
          {"threads", row.threads},
          {"mean_area", row.mean_area},
          {"min_area", row.min_area},
          {"max_area", row.max_area},
          {"voxels", row.voxels},
          {"wall_seconds", row.wall},
          {"user_seconds", row.user},
          {"system_seconds", row.system},
          {"wall_seconds_per_triangle", row.wall / triangles},
          {"user_seconds_per_triangle", row.user / triangles},
          {"system_seconds_per_triangle", row.system / triangles},
          {"cpu_seconds_per_triangle", (row.user + row.system) / triangles}};
}

json json_of(std::span<const tasks::PublishedTimes> published) {
  json rows = json::array();
  for (const tasks::PublishedTimes& each : published) {
    json seconds = json::array();
    for (const double time : each.seconds) seconds.push_back(time == 0 ? json() : json(time));
    rows.push_back({{"machine", each.machine}, {"algorithm", each.algorithm}, {"seconds", seconds}});
  }
  return rows;
}

// One of the tables F.5 and F.6: the published rows, and ours under the areas that they share.
template <typename Seconds>
std::string comparison(const tasks::VoxelizeTable& table, const std::vector<int>& threads,
                       std::span<const tasks::PublishedTimes> published, std::string_view title,
                       Seconds&& seconds) {
  std::string text = fmt::format("\n{:<34}", title);
  for (const double area : tasks::kPublishedAreas) text += fmt::format(" {:>9g}", area);
  text += "\n";
  for (const tasks::PublishedTimes& each : published) {
    text += fmt::format("{:<34}", fmt::format("{}: {}", each.machine, each.algorithm));
    for (const double time : each.seconds)
      text += time == 0 ? fmt::format(" {:>9}", "<0.01") : fmt::format(" {:>9.2f}", time);
    text += "\n";
  }
  for (const int count : threads) {
    text += fmt::format("{:<34}",
                        fmt::format("here: {}, {} thread{}", table.voxelizer, count, count == 1 ? "" : "s"));
    for (const double area : tasks::kPublishedAreas) {
      std::string cell = "-";
      for (const tasks::VoxelizeTableRow& row : table.rows) {
        if (row.asked_area == area && row.threads == count) cell = fmt::format("{:.4g}", seconds(row));
      }
      text += fmt::format(" {:>9}", cell);
    }
    text += "\n";
  }
  return text;
}

std::string text_of(const tasks::VoxelizeTable& table) {
  std::string text =
      fmt::format("{:>9} {:>7} {:>11} {:>11} {:>11} {:>13} {:>11} {:>11} {:>11} {:>12} {:>10}\n", "area",
                  "threads", "mean area", "min area", "max area", "voxels", "wall s", "user s", "system s",
                  "us/triangle", "M voxels/s");
  for (const tasks::VoxelizeTableRow& row : table.rows) {
    text += fmt::format(
        "{:>9} {:>7} {:>11.6g} {:>11.6g} {:>11.6g} {:>13} {:>11.6f} {:>11.6f} {:>11.6f} {:>12.3f} "
        "{:>10.1f}\n",
        fmt::format("{:g}", row.asked_area), row.threads, row.mean_area, row.min_area, row.max_area,
        row.voxels, row.wall, row.user, row.system, 1e6 * row.wall / table.triangles,
        row.wall > 0 ? static_cast<double>(row.voxels) / row.wall / 1e6 : 0);
  }
  return text;
}

// The statistics of one triple as the seed's program prints them.
std::string statistics_of(const tasks::VoxelizeTable& table, const tasks::VoxelizeTableRow& row) {
  const auto line = [&](std::string_view what, double seconds) {
    return fmt::format("{:.<44}: {:.5f}/{:.7f}\n", what, seconds, seconds / table.triangles);
  };
  return fmt::format("Used {} threads, algorithm = {}\n", row.threads, table.voxelizer) +
         line("Total/per triangle wallclock time", row.wall) +
         line("Total/per triangle CPU user time", row.user) +
         line("Total/per triangle CPU system time", row.system) +
         line("Total/per triangle CPU user+sys time", row.user + row.system) +
         fmt::format("{:.<44}: {:.5f}/{:.5f}/{:.5f}\n", "Average/max/min triangle area", row.mean_area,
                     row.max_area, row.min_area) +
         fmt::format("{:.<44}: {}\n", "Voxels", row.voxels);
}

console::Output of_table(const Options& options, const console::Console& console) {
  tasks::VoxelizeTableOptions table_options;
  table_options.voxelizer = options.file.voxelizer;
  table_options.output =
      options.output == "spans" ? tasks::VoxelOutput::kSpans : tasks::VoxelOutput::kCoordinates;
  table_options.threads = options.threads;
  table_options.runs = options.runs.value_or(20);
  table_options.one_triangle = options.one_triangle;
  table_options.areas = options.areas;
  if (!options.vertices.empty()) {
    table_options.vertices = {tasks::parse_vertex(options.vertices[0]),
                              tasks::parse_vertex(options.vertices[1]),
                              tasks::parse_vertex(options.vertices[2])};
  }
  const tasks::VoxelizeTable table = tasks::bench_voxelize_table(table_options, console.job());
  console::Output output;
  json rows = json::array();
  for (const tasks::VoxelizeTableRow& row : table.rows) rows.push_back(json_of(row, table.triangles));
  output.json = {{"voxelizer", table.voxelizer},
                 {"simd", table.simd},
                 {"output", options.output},
                 {"runs", table.runs},
                 {"triangles", table.triangles},
                 {"checked_triangles", table.check.triangles},
                 {"rows", rows}};
  if (options.vertices.empty()) {
    output.json["published"] = {{"areas", tasks::kPublishedAreas},
                                {"wall", json_of(tasks::published_wall_times())},
                                {"cpu", json_of(tasks::published_cpu_times())}};
    output.text = text_of(table);
    output.text += comparison(table, options.threads, tasks::published_wall_times(),
                              "wall seconds (table F.5), area", [](const auto& row) { return row.wall; });
    output.text +=
        comparison(table, options.threads, tasks::published_cpu_times(), "user + system s (table F.6), area",
                   [](const auto& row) { return row.user + row.system; });
    output.text += "\n";
  } else {
    for (const tasks::VoxelizeTableRow& row : table.rows) output.text += statistics_of(table, row) + "\n";
  }
  output.text += fmt::format(
      "512 triangles, {}, mean of {} runs, {}; {} triangles were compared with the definition first\n",
      options.output, table.runs, table.simd, table.check.triangles);
  if (table.differences.triangles > 0) {
    output.json["differences"] = json_of(table.differences);
    output.text += text_of(table.differences);
  }
  return output;
}

console::Output of_gather(const Options& options, const console::Console& console) {
  tasks::GatherOptions gather;
  gather.from_memory = options.gather == "memory";
  gather.voxelizer = options.file.voxelizer;
  if (!options.areas.empty()) gather.areas = options.areas;
  gather.runs = options.runs.value_or(gather.runs);
  const tasks::GatherResult done = tasks::bench_gather(gather, console.job());
  console::Output output;
  json rows = json::array();
  output.text = fmt::format("{:>9} {:>9} {:>12} {:>14} {:>16} {:>18}\n", "area", "faces", "voxels",
                            "spans M/s", "folded M/s", "ordered faces M/s");
  for (const tasks::GatherRow& row : done.rows) {
    rows.push_back({{"area", row.area},
                    {"faces", row.faces},
                    {"voxels", row.voxels},
                    {"spans_per_second", row.spans},
                    {"folded_per_second", row.folded},
                    {"folded_ordered_per_second", row.folded_ordered}});
    output.text += fmt::format("{:>9g} {:>9} {:>12} {:>14.1f} {:>16.1f} {:>18.1f}\n", row.area, row.faces,
                               row.voxels, row.spans / 1e6, row.folded / 1e6, row.folded_ordered / 1e6);
  }
  output.json = {{"simd", done.simd},
                 {"gather", options.gather},
                 {"dims", done.dims},
                 {"checked_faces", done.checked_faces},
                 {"rows", rows}};
  output.text += fmt::format(
      "{} x {} x {} values, {}, voxels for a second of processor time, one thread; {} faces were compared "
      "with the definition first\n",
      done.dims[0], done.dims[1], done.dims[2], done.simd, done.checked_faces);
  return output;
}

console::Output run(const Options& options, const console::Console& console) {
  const int modes = (options.file.triangles.empty() ? 0 : 1) + (options.table ? 1 : 0) +
                    (options.vertices.empty() ? 0 : 1) + (options.gather.empty() ? 0 : 1);
  if (modes != 1) {
    throw Error(ErrorCode::kUsage,
                modes == 0 ? "nothing was given to voxelize" : "several benchmarks were asked for at once",
                "give one of --triangles FILE, --table, --vertices V1 V2 V3, --gather cache|memory");
  }
  if (options.table || !options.vertices.empty()) return of_table(options, console);
  if (!options.gather.empty()) return of_gather(options, console);
  if (options.threads.size() != 1) {
    throw Error(ErrorCode::kUsage, "--triangles takes one number of threads", "lists are for --table");
  }
  tasks::BenchVoxelizeOptions file = options.file;
  file.threads = options.threads.front();
  return of_file(file, console);
}

}  // namespace

void add_bench_voxelize(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "voxelize", "Voxelize triangles: a file, the seed's benchmark, or with their values",
                  [options](console::Console& console) { return run(*options, console); });
  tasks::BenchVoxelizeOptions& file = options->file;
  command->add_option("--triangles", file.triangles, "CSV: i0,j0,k0,i1,j1,k1,i2,j2,k2 a line, in voxels");
  command->add_flag("--table", options->table,
                    "The rows of the seed's tables F.5 and F.6: 512 triangles for each mean area");
  command->add_option("--vertices", options->vertices, "One triple x,y,z x,y,z x,y,z with all 512 signs")
      ->expected(3);
  command
      ->add_option("--gather", options->gather,
                   "cache|memory: voxelize, gather and fold random faces of a volume")
      ->check(CLI::IsMember({"cache", "memory"}));
  command->add_option("--voxelizer", file.voxelizer, "exact (default), rotated[=lc|plain], kaufman");
  command->add_option("--threads", options->threads, "Threads (default 1); a list for --table: 1,2")
      ->delimiter(',');
  command->add_option("--repeats", file.repeats, "Timed runs of --triangles; the median counts (default 5)");
  command->add_option("--list", file.list,
                      "Write every voxel of --triangles to this file: triangle,i,j,k a line");
  command
      ->add_option("--areas", options->areas, "Mean areas in voxels^2 instead of the default ones: 10,1000")
      ->delimiter(',');
  command->add_option("--runs", options->runs, "Runs of --table (20), --vertices (20) or --gather (5)");
  command
      ->add_option(
          "--output", options->output,
          "coordinates (default: a list in memory, as the seed) or spans, for --table and --vertices")
      ->check(CLI::IsMember({"coordinates", "spans"}));
  command->add_flag("--one-triangle", options->one_triangle,
                    "The same triangle 512 times instead of 512 signs");
}

}  // namespace footwall::commands
