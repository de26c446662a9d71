// footwall bench render: pictures of isosurfaces and meshes, by all ranks.
#include "app/footwall/commands/bench_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/render_bench.h"

namespace footwall::commands {
namespace {

using Kind = session::BenchedScene::Kind;

struct Options {
  std::string size = "1024x1024", raw, dims, mesh, synthetic, group_threshold;
  std::optional<float> value;
  std::optional<std::int64_t> triangles;
  session::RenderBench bench;
  EngineOptions engine;
};

session::BenchedScene scene_of(const Options& options) {
  session::BenchedScene scene = options.bench.scene;
  const int given =
      (options.raw.empty() ? 0 : 1) + (options.mesh.empty() ? 0 : 1) + (options.synthetic.empty() ? 0 : 1);
  if (given != 1) {
    throw Error(ErrorCode::kUsage, "bench render draws one thing",
                "give one of --raw FILE --dims X,Y,Z --value V, --mesh FILE, or --synthetic sphere|gyroid "
                "--triangles N");
  }
  if (!options.raw.empty()) {
    if (options.dims.empty() || !options.value)
      throw Error(ErrorCode::kUsage, "--raw needs --dims and --value", "as --dims 256,256,256 --value 0.5");
    scene.kind = Kind::kRaw;
    scene.file = options.raw;
    std::string dims = options.dims;
    std::replace(dims.begin(), dims.end(), ',', 'x');
    scene.dims = dims_from(dims, "--dims");
    scene.value = *options.value;
    return scene;
  }
  if (!options.mesh.empty()) {
    scene.kind = Kind::kMesh;
    scene.file = options.mesh;
    return scene;
  }
  if (options.synthetic != "sphere" && options.synthetic != "gyroid") {
    throw Error(ErrorCode::kUsage, fmt::format("there is no synthetic mesh '{}'", options.synthetic),
                "choose one of: sphere, gyroid");
  }
  scene.kind = options.synthetic == "sphere" ? Kind::kSphere : Kind::kGyroid;
  scene.triangles = options.triangles.value_or(1'000'000);
  return scene;
}

console::Output run(Options& options, const console::Console& console) {
  session::RenderBench& bench = options.bench;
  const auto [width, height] = picture_size_from(options.size);
  bench.width = width;
  bench.height = height;
  bench.scene = scene_of(options);
  if (bench.scene.pyramid && bench.scene.kind != Kind::kRaw && bench.scene.kind != Kind::kGyroid)
    throw Error(ErrorCode::kUsage, "a mesh has no bricks to skip",
                "give --pyramid with --raw or --synthetic gyroid");
  if (!options.group_threshold.empty()) bench.group_threshold = group_threshold_from(options.group_threshold);
  const std::string result = tasks::bench_render(bench, options.engine.launch(), console.job());
  console::Output output;
  output.json = console::Json::parse(result);
  output.json["size"] = {width, height};
  output.json["checked"] = true;
  std::vector<double> seconds = output.json.at("seconds").get<std::vector<double>>();
  std::sort(seconds.begin(), seconds.end());
  output.json["median"] = seconds[seconds.size() / 2];
  output.text = fmt::format(
      "{} triangles, {} x {} pixels, {} ranks of {} threads: median {:.2f} ms ({:.2f} to {:.2f}), picture "
      "{}\n",
      output.json.at("triangles").get<std::int64_t>(), width, height, output.json.at("ranks").get<int>(),
      output.json.at("threads").get<int>(), 1e3 * seconds[seconds.size() / 2], 1e3 * seconds.front(),
      1e3 * seconds.back(), output.json.at("picture").get<std::string>());
  for (const char* phase :
       {"extract", "group", "project", "rasterize", "shade", "merge", "gather", "assemble"}) {
    const console::Json& rate = output.json.at("mtriangles_per_second").at(phase);
    output.text += fmt::format("{:>10} {:>9.2f} ms {:>10} Mtriangle/s\n", phase,
                               1e3 * output.json.at("phases").at(phase).get<double>(),
                               rate.is_null() ? "-" : fmt::format("{:.1f}", rate.get<double>()));
  }
  if (!output.json.at("samples_mib").is_null())
    output.text +=
        fmt::format("{:.1f} MiB of samples on a rank\n", output.json.at("samples_mib").get<double>());
  if (!output.json.at("pyramid_seconds").is_null()) {
    output.text += fmt::format("the bricks' ranges were made once, in {:.2f} ms\n",
                               1e3 * output.json.at("pyramid_seconds").get<double>());
  }
  output.text += fmt::format(
      "merged {} pixels in {} bytes; {} bytes in {} messages in all\n",
      output.json.at("merged_pixels").get<std::int64_t>(), output.json.at("merged_bytes").get<std::int64_t>(),
      output.json.at("bytes_sent").get<std::int64_t>(), output.json.at("messages").get<std::int64_t>());
  return output;
}

}  // namespace

void add_bench_render(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "render", "How long a picture of an isosurface or mesh takes on all ranks",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("--size", options->size, "Pixels (default 1024x1024)");
  command->add_option("--raw", options->raw, "A raw little-endian float32 volume, its first axis fastest");
  command->add_option("--dims", options->dims, "Samples of the raw volume, X,Y,Z, X fastest");
  command->add_option("--value", options->value, "The isovalue");
  command->add_option("--mesh", options->mesh, "A PLY or binary STL file");
  command->add_option("--synthetic", options->synthetic, "sphere (a mesh) or gyroid (a volume)");
  command->add_option("--triangles", options->triangles, "About how many it has (default 1000000)");
  command->add_flag("--pyramid", options->bench.scene.pyramid,
                    "Of a volume: skip bricks by their smallest and largest values");
  command->add_option("--repeat", options->bench.repeat, "Pictures that are measured (default 5)");
  command->add_option("--group-threshold", options->group_threshold,
                      "Ranks share triangles rather than pictures up to this share of a picture's bytes "
                      "(default 0.1), or auto: where it is estimated to be quicker");
  options->engine.add_to(*command);
}

}  // namespace footwall::commands
