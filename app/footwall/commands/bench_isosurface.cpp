#include "app/footwall/commands/bench_isosurface.h"

#include <fmt/format.h>

#include <memory>

#include "app/footwall/commands/bench_isosurface_ranks.h"
#include "app/footwall/commands/options.h"
#include "engine/isosurface/registry.h"
#include "engine/synthetic/fields.h"
#include "engine/tasks/bench_isosurface.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

using nlohmann::ordered_json;

struct Options {
  tasks::BenchIsosurfaceOptions how;
  std::string dims, sweep;
  bool no_check = false;
  RanksOptions ranks;
};

template <class Kind>
std::string names_of(std::span<const Kind> kinds) {
  std::string names;
  for (const Kind& kind : kinds) names += fmt::format("{}{}", names.empty() ? "" : ", ", kind.name);
  return names;
}

tasks::IsovalueSweep sweep_from(const std::string& words) {
  const auto parts = text::split(words, ':');
  if (parts.size() == 3) {
    const auto first = text::number(parts[0]), last = text::number(parts[1]);
    const std::int64_t count = text::integer(parts[2]).value_or(0);
    if (first && last && count >= 1 && count <= 10000) {
      return {static_cast<float>(*first), static_cast<float>(*last), static_cast<int>(count)};
    }
  }
  throw Error(ErrorCode::kUsage, fmt::format("--sweep {} says no isovalues", words),
              "give first, last and how many, e.g. 0:100:21");
}

console::Output of_sweep(const Options& options, const console::Console& console) {
  const auto rows = tasks::sweep_isovalues(options.how, sweep_from(options.sweep), console.job());
  console::Output output;
  output.json = {
      {"repeats", options.how.repeats}, {"normals", options.how.normals}, {"rows", ordered_json::array()}};
  output.text = fmt::format("{:>12} {:>11} {:>12} {:>12} {:>7}\n", "isovalue", "triangles", "cubes s",
                            "vector s", "gain");
  for (const tasks::SweepRow& row : rows) {
    output.json["rows"].push_back({{"value", row.value},
                                   {"triangles", row.triangles},
                                   {"cubes_seconds", row.cubes_seconds},
                                   {"vector_seconds", row.vector_seconds},
                                   {"gain", row.gain}});
    output.text += fmt::format("{:>12g} {:>11} {:>12.6f} {:>12.6f} {:>7.2f}\n", row.value, row.triangles,
                               row.cubes_seconds, row.vector_seconds, row.gain);
  }
  output.text += fmt::format(
      "medians of {} runs on one thread; both gave the same surface at each isovalue\n", options.how.repeats);
  return output;
}

template <class Number>
ordered_json or_null(const std::optional<Number>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

ordered_json json_of(const tasks::BenchIsosurfaceResult& done) {
  const isosurface::Properties& surface = done.properties;
  return {{"volume", done.volume},
          {"dims", done.dims},
          {"value", done.value},
          {"variant", done.variant},
          {"tables", done.tables},
          {"threads", done.threads},
          {"simd", done.simd},
          {"triangles", surface.triangles},
          {"vertices", surface.vertices},
          {"seconds", done.seconds},
          {"seconds_reused", done.seconds_reused},
          {"median_seconds", done.median},
          {"median_seconds_reused", done.median_reused},
          {"cpu_seconds", done.cpu_seconds},
          {"voxels_per_second", done.voxels_per_second},
          {"triangles_per_second", done.triangles_per_second},
          {"boundary_edges", surface.boundary_edges.inside},
          {"boundary_edges_at_border", surface.boundary_edges.at_border},
          {"boundary_edges_at_nulls", surface.boundary_edges.at_nulls},
          {"non_manifold_edges", surface.non_manifold_edges},
          {"euler", surface.euler},
          {"components", surface.components.size()},
          {"closed_components", surface.closed_components},
          {"genus", surface.genus},
          {"area", surface.area},
          {"enclosed_volume", or_null(surface.volume)},
          {"input_mib", done.input_mib},
          {"peak_mib", done.peak_mib},
          {"pyramid_seconds", or_null(done.pyramid_seconds)},
          {"bricks_active", or_null(done.bricks_active)},
          {"undecided_cells", or_null(done.undecided_cells)},
          {"cells_decided_otherwise", or_null(done.other_cells)},
          {"checked_against",
           done.checked_against.empty() ? ordered_json() : ordered_json(done.checked_against)}};
}

std::string text_of(const tasks::BenchIsosurfaceResult& done) {
  const isosurface::Properties& surface = done.properties;
  std::string text =
      fmt::format("{} {}x{}x{} at {:g}: {} triangles, {} vertices, {} components, Euler number {}\n",
                  done.volume, done.dims[0], done.dims[1], done.dims[2], done.value, surface.triangles,
                  surface.vertices, surface.components.size(), surface.euler);
  text += fmt::format("boundary edges: {} inside the volume, {} at its border, {} at nulls\n",
                      surface.boundary_edges.inside, surface.boundary_edges.at_border,
                      surface.boundary_edges.at_nulls);
  text += fmt::format("{:<8} {:<9} {:<9} {:>7} {:>11} {:>11} {:>11} {:>12} {:>10}\n", "variant", "tables",
                      "simd", "threads", "median s", "reused s", "Mvoxel/s", "Mtriangle/s", "peak MiB");
  text += fmt::format("{:<8} {:<9} {:<9} {:>7} {:>11.6f} {:>11.6f} {:>11.1f} {:>12.2f} {:>10.1f}\n",
                      done.variant, done.tables, done.simd, done.threads, done.median, done.median_reused,
                      done.voxels_per_second / 1e6, done.triangles_per_second / 1e6, done.peak_mib);
  if (done.pyramid_seconds) {
    text += fmt::format("bricks: {:.2f} % active; their ranges were made once, in {:.6f} s\n",
                        100 * *done.bricks_active, *done.pyramid_seconds);
  }
  if (done.undecided_cells) {
    text +=
        fmt::format("of {} cells that their signs leave open {} are decided otherwise than by the field\n",
                    *done.undecided_cells, *done.other_cells);
  }
  text += done.checked_against.empty()
              ? "the surface was NOT compared with that of another variant\n"
              : fmt::format("the surface is the one that {} gives, bit for bit\n", done.checked_against);
  return text;
}

console::Output run(Options& options, const console::Console& console) {
  options.how.check = !options.no_check;
  if (!options.dims.empty()) options.how.dims = dims_from(options.dims, "--dims");
  if (!options.how.raw.empty() && options.dims.empty()) {
    throw Error(ErrorCode::kUsage, "the sizes of the raw volume are not known",
                "give --dims X,Y,Z, x the fastest");
  }
  if (options.ranks.given()) return options.ranks.run(options.how, console.job());
  if (!options.sweep.empty()) return of_sweep(options, console);
  const tasks::BenchIsosurfaceResult done = tasks::bench_isosurface(options.how, console.job());
  return {json_of(done), text_of(done)};
}

}  // namespace

void add_bench_isosurface(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(group, "isosurface",
                                  "Extract an isosurface from a raw or synthetic volume, checked and timed",
                                  [options](console::Console& console) { return run(*options, console); });
  tasks::BenchIsosurfaceOptions& how = options->how;
  command->add_option("--raw", how.raw, "Volume: little-endian float32, nothing else; NaN is null");
  command->add_option("--dims", options->dims, "Its sizes X,Y,Z, x the fastest (our samples)");
  command->add_option("--synthetic", how.synthetic,
                      "A made-up volume instead: " + names_of(synthetic::field_kinds()));
  command->add_option("--size", how.size, "Its samples on each axis (default 256)");
  command->add_option("--write-raw", how.write_raw, "Write the volume to this file, for other programs");
  command->add_option("--value", how.value, "Isovalue (default: the synthetic volume's own)");
  command->add_option("--variant", how.variant,
                      "How to extract: " + names_of(isosurface::variants()) + " (default bricks)");
  command->add_option("--tables", how.tables,
                      "trilinear (default), seed, seed000, seed002: rules for ambiguous cells");
  command->add_option("--threads", how.threads, "Threads, of bricks alone (default 1)");
  command->add_option("--repeat", how.repeats, "Timed runs; the median counts (default 5)");
  command->add_flag("--normals,!--no-normals", how.normals, "Compute normals (default), or leave them out");
  command->add_flag("--pyramid", how.pyramid, "Skip bricks by their smallest and largest values");
  command->add_flag("--no-check", options->no_check, "Do not compare with another variant, and say so");
  command->add_option("--sweep", options->sweep,
                      "FIRST:LAST:COUNT isovalues: how much faster vector is than cubes at each");
  options->ranks.add_to(*command);
}

}  // namespace footwall::commands
