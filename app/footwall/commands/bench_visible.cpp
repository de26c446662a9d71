#include "app/footwall/commands/bench_visible.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "engine/session/private_folder.h"
#include "engine/tasks/bench_isosurface.h"
#include "engine/tasks/visible_bench/visible_bench.h"
#include "storage/base/text.h"
#include "storage/formats/raw.h"

namespace footwall::commands {
namespace {

constexpr int kMostRanks = 1024;
constexpr int kMostRepeats = 1000;

struct Options {
  tasks::BenchIsosurfaceOptions volume;
  std::string dims, modes = "depth,paper", ranks = "1,2,4,8", picture = "1024x1024", cell,
                    estimate_cells = "4,1";
  std::vector<std::string> views;
  std::optional<int> threads;
  bool orthographic = false;
  tasks::VisibleBench bench;
};

// "8" or "8x8x4".
survey::Index cell_from(const std::string& words, const std::string& option) {
  const std::vector<std::string_view> parts = text::split(words, 'x');
  survey::Index cell{0, 0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto number = parts.size() == 1   ? text::integer(parts[0])
                        : parts.size() == 3 ? text::integer(parts[axis])
                                            : std::nullopt;
    if (!number || *number < 1) {
      throw Error(ErrorCode::kUsage, fmt::format("{} {} is no size of a cell", option, words),
                  "give the cells of the lattice along each axis, as 8 or 8x8x4");
    }
    cell[axis] = *number;
  }
  return cell;
}

tasks::VisibleView view_from(const std::string& words) {
  const std::vector<std::string_view> parts = text::split(words, ',');
  const auto azimuth = parts.size() == 2 ? text::number(parts[0]) : std::nullopt;
  const auto elevation = parts.size() == 2 ? text::number(parts[1]) : std::nullopt;
  if (!azimuth || !elevation) {
    throw Error(ErrorCode::kUsage, fmt::format("--view {} says no view", words),
                "give azimuth and elevation in degrees, as 30,25");
  }
  return {*azimuth, *elevation};
}

std::vector<int> ranks_from(const std::string& words) {
  std::vector<int> ranks;
  for (const std::string_view part : text::split(words, ',')) {
    const auto number = text::integer(part);
    if (!number || *number < 1 || *number > kMostRanks) {
      throw Error(ErrorCode::kUsage, fmt::format("--ranks {} says no numbers of ranks", words),
                  fmt::format("give 1 to {}, with commas, as 1,2,4,8", kMostRanks));
    }
    ranks.push_back(static_cast<int>(*number));
  }
  return ranks;
}

console::Output run(Options& options, const console::Console& console) {
  tasks::VisibleBench& bench = options.bench;
  if (!options.dims.empty()) options.volume.dims = dims_from(options.dims, "--dims");
  if (!options.volume.raw.empty() && options.dims.empty()) {
    throw Error(ErrorCode::kUsage, "the sizes of the raw volume are not known",
                "give --dims X,Y,Z, x the fastest");
  }
  if (bench.repeats < 1 || bench.repeats > kMostRepeats) {
    throw Error(ErrorCode::kUsage, fmt::format("--repeat {} makes no sense", bench.repeats),
                fmt::format("give 1 to {}", kMostRepeats));
  }
  std::vector<std::string> modes;
  for (const std::string_view mode : text::split(options.modes, ',')) {
    if (mode != "depth" && mode != "paper") {
      throw Error(ErrorCode::kUsage, fmt::format("there is no mode '{}'", mode),
                  "give depth, paper or depth,paper");
    }
    modes.emplace_back(mode);
  }
  const std::vector<int> ranks = ranks_from(options.ranks);
  const auto [width, height] = picture_size_from(options.picture);
  bench.width = width;
  bench.height = height;
  bench.perspective = !options.orthographic;
  if (!options.cell.empty()) bench.cell = cell_from(options.cell, "--cell");
  for (const std::string_view part : text::split(options.estimate_cells, ','))
    bench.estimate_cells.push_back(cell_from(std::string(part), "--estimate-cell"));
  if (options.views.empty()) options.views = {"30,25", "210,-10"};
  for (const std::string& view : options.views) bench.views.push_back(view_from(view));
  session::LaunchOptions launch;
  if (options.threads.value_or(1) < 1) throw Error(ErrorCode::kUsage, "--threads must be at least 1");
  launch.threads = options.threads.value_or(1);

  const session::PrivateFolder folder(session::temporary_home());
  const tasks::BenchVolume volume = tasks::load_bench_volume(options.volume, console.job());
  bench.raw = folder.path() / "volume.raw";
  bench.size = volume.size;
  bench.value = volume.value;
  formats::raw::write(bench.raw, volume.size, [&](const survey::Box& box, std::span<float> values) {
    // Whole planes.
    const auto plane = static_cast<std::size_t>(volume.size[1] * volume.size[2]);
    const auto first = static_cast<std::size_t>(box.lo[0]) * plane;
    std::copy_n(volume.values.begin() + static_cast<std::ptrdiff_t>(first), values.size(), values.begin());
  });
  console::Output output;
  output.json = console::Json::parse(tasks::bench_visible(bench, modes, ranks, launch, console.job()));
  output.json["volume"] = volume.name;
  output.text = visible_tables(output.json);
  return output;
}

}  // namespace

void add_bench_visible(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "visible", "What only the visible part of an isosurface costs, by ranks and passes",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("--raw", options->volume.raw,
                      "Volume: little-endian float32, nothing else; NaN is null");
  command->add_option("--dims", options->dims, "Its sizes X,Y,Z, x the fastest (our samples)");
  command->add_option("--synthetic", options->volume.synthetic,
                      "A made-up volume instead: sphere, gyroid, envelope");
  command->add_option("--size", options->volume.size, "Its samples on each axis (default 256)");
  command->add_option("--value", options->volume.value, "Isovalue (default: the synthetic volume's own)");
  command->add_option(
      "--mode", options->modes,
      "How visible cells are found: depth, paper (seed 003's), or both (default depth,paper)");
  command->add_option("--view", options->views,
                      "AZIMUTH,ELEVATION in degrees, several times (default 30,25 and 210,-10)");
  command->add_flag("--orthographic", options->orthographic, "Parallel lines of sight");
  command->add_option("--picture", options->picture, "Pixels (default 1024x1024)");
  command->add_option(
      "--cell", options->cell,
      "Mode paper: lattice cells of an octree's cell: N or NxMxK (default: about 32 cells along each axis)");
  command->add_option(
      "--estimate-cell", options->estimate_cells,
      "Mode paper: in what work is estimated, N or NxMxK, with commas; each is measured (default 4,1)");
  command->add_option("--ranks", options->ranks, "Numbers of MPI ranks, with commas (default 1,2,4,8)");
  command->add_option("--threads", options->threads, "Threads of each rank (default 1)");
  command->add_option("--repeat", options->bench.repeats,
                      "Runs that are measured; the median counts (default 5)");
}

}  // namespace footwall::commands
