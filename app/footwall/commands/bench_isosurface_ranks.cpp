#include "app/footwall/commands/bench_isosurface_ranks.h"

#include <fmt/format.h>

#include <fstream>

#include "engine/session/private_folder.h"
#include "engine/tasks/isosurface_ranks/ranks_run.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

constexpr int kMostRanks = 1024;

std::vector<isosurface::Interleaving> ways_from(const std::string& pillars, const std::string& interleave) {
  std::vector<isosurface::Interleaving> ways;
  if (!interleave.empty()) {
    const isosurface::Interleaving most = isosurface::parse_interleaving(interleave);
    for (int a = 1; a <= most[0]; ++a) {
      for (int b = 1; b <= most[1]; ++b) ways.push_back({a, b, most[2]});
    }
  }
  if (!pillars.empty()) {
    for (const std::string_view one : text::split(pillars, ','))
      ways.push_back(isosurface::parse_interleaving(one));
  }
  if (ways.empty()) ways.push_back({1, 1, 1});
  return ways;
}

void write_raw(const std::filesystem::path& path, std::span<const float> values) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
  file.close();
  if (!file) throw Error(ErrorCode::kIo, fmt::format("cannot write {}", path.string()));
}

std::string table_of(const console::Json& result) {
  constexpr double kMilli = 1e3;
  std::string text =
      fmt::format("{} ranks, {} triangles, {} vertices; the automatic choice is {}\n",
                  result.at("ranks").get<int>(), result.at("triangles").get<std::uint64_t>(),
                  result.at("vertices").get<std::uint64_t>(), result.at("chosen").get<std::string>());
  text += fmt::format("{:>9} {:>10} {:>10} {:>10} {:>10} {:>11} {:>11}\n", "pillars", "mean ms", "slowest ms",
                      "imbalance", "wall ms", "redundant", "overlap");
  for (const console::Json& row : result.at("rows")) {
    text += fmt::format(
        "{:>9} {:>10.3f} {:>10.3f} {:>9.1f}% {:>10.3f} {:>11} {:>11}\n", row.at("pillars").get<std::string>(),
        kMilli * row.at("mean_seconds").get<double>(), kMilli * row.at("max_seconds").get<double>(),
        100 * row.at("load_imbalance").get<double>(), kMilli * row.at("wall_seconds").get<double>(),
        row.at("redundant_intersections").get<std::int64_t>(), row.at("overlap_samples").get<std::int64_t>());
  }
  text +=
      "mean and slowest: processor time of the ranks; each way gave the surface of the whole, bit for bit";
  return text;
}

}  // namespace

void RanksOptions::add_to(CLI::App& command) {
  command.add_option("--ranks", ranks,
                     "Extract on so many MPI ranks, and tell load imbalance and redundant work");
  command.add_option(
      "--pillars", pillars,
      "Ways to cut the volume, AxB or AxBxL (L layers along samples), comma separated (default 1x1)");
  command.add_option("--interleave", interleave, "All ways from 1x1 to AxB, in L layers: AxB or AxBxL");
}

console::Output RanksOptions::run(const tasks::BenchIsosurfaceOptions& how, const JobContext& job) const {
  if (ranks.value_or(1) < 1 || ranks.value_or(1) > kMostRanks) {
    throw Error(ErrorCode::kUsage, fmt::format("there cannot be {} ranks", *ranks),
                fmt::format("give 1 to {}", kMostRanks));
  }
  tasks::RanksRun run;
  run.interleavings = ways_from(pillars, interleave);
  run.variant = how.variant;
  run.repeats = how.repeats;
  run.threads = how.threads;
  run.normals = how.normals;
  run.pyramid = how.pyramid;
  const session::PrivateFolder folder(session::temporary_home());
  run.raw = folder.path() / "volume.raw";
  if (how.raw.empty() && how.synthetic.empty()) {
    write_raw(run.raw, tasks::central_volume());
    run.size = tasks::kCentralSize;
    run.value = how.value.value_or(0);
  } else {
    const tasks::BenchVolume volume = tasks::load_bench_volume(how, job);
    write_raw(run.raw, volume.values);
    run.size = volume.size;
    run.value = volume.value;
  }
  session::LaunchOptions launch;
  launch.ranks = ranks.value_or(1);
  launch.threads = how.threads;
  const console::Json result = console::Json::parse(tasks::bench_isosurface_ranks(run, launch, job));
  return {result, table_of(result)};
}

}  // namespace footwall::commands
