#include "engine/session/render_bench.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "engine/render/camera.h"
#include "engine/render/composite/compose.h"
#include "engine/session/group_options.h"
#include "engine/session/job_json.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;
using Kind = BenchedScene::Kind;

constexpr double kAzimuth = 30;
constexpr double kElevation = 25;

struct NamedKind {
  const char* name;
  Kind kind;
};
constexpr NamedKind kKinds[] = {
    {"raw", Kind::kRaw}, {"mesh", Kind::kMesh}, {"sphere", Kind::kSphere}, {"gyroid", Kind::kGyroid}};

// The finished picture, as somebody who asked for it would take it.
struct Finished {
  std::vector<float> depth;
  std::vector<render::Rgba> rgba;

  explicit Finished(std::size_t pixels) : depth(pixels), rgba(pixels) {}
  void assemble(const render::SurfaceLayer& layer, int threads) {
    const auto width = static_cast<std::size_t>(layer.width());
#pragma omp parallel for num_threads(threads)
    for (int y = 0; y < layer.height(); ++y) {
      const std::size_t first = static_cast<std::size_t>(y) * width;
      layer.row(y, std::span(depth).subspan(first, width), std::span(rgba).subspan(first, width));
    }
  }
  std::uint64_t hash() const {
    return hash64(std::as_bytes(std::span(depth))) ^ 3 * hash64(std::as_bytes(std::span(rgba)));
  }
};

// The same picture without any of what makes it fast: rank 0 draws the triangles of all ranks one after the
// other. Returns how many pixels are seen. Collective.
std::int64_t check_picture(comm::Communicator& world, const BenchSource& source, const render::Camera& camera,
                           const RenderBench& bench, const Finished& picture) {
  std::vector<comm::Bytes> outgoing(static_cast<std::size_t>(world.size()));
  outgoing.front() = render::bytes_of(source.surfaces());
  const std::vector<comm::Bytes> received = world.exchange(std::move(outgoing));
  return world.collectively([&]() -> std::int64_t {
    if (world.rank() != 0) return 0;
    std::vector<render::OwnedSurface> owned;
    for (const comm::Bytes& bytes : received) {
      for (render::OwnedSurface& surface : render::surfaces_from(bytes)) owned.push_back(std::move(surface));
    }
    std::vector<render::LitSurface> surfaces;
    for (const render::OwnedSurface& surface : owned) surfaces.push_back(surface.view());
    render::VisibilityBuffer window(bench.width, bench.height);
    for (const render::LitSurface& surface : surfaces) {
      const render::Matrix4 to_clip = surface.placement.then(camera.view_projection);
      std::size_t run = 0;
      for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        while (run + 1 < surface.runs.size() && surface.runs[run + 1].first_triangle <= t) ++run;
        const auto clip = [&](std::size_t n) {
          const auto v = static_cast<std::size_t>(surface.triangles[t][n]);
          return render::transformed(to_clip, render::Vec3(surface.positions[v]));
        };
        const auto id = static_cast<render::PrimitiveId>(t - surface.runs[run].first_triangle);
        render::rasterize_clip(clip(0), clip(1), clip(2), surface.runs[run].first_id + id, window);
      }
    }
    render::SurfaceFrame frame;
    frame.project(surfaces, camera, bench.width, bench.height, 1);
    std::vector<render::Rgba> colours(window.pixels().size());
    frame.shade(window, colours, 1);
    std::int64_t seen = 0;
    for (std::size_t n = 0; n < colours.size(); ++n) {
      const render::Visible pixel = window.pixels()[n];
      seen += pixel != render::kBackground ? 1 : 0;
      if (render::depth_of(pixel) == picture.depth[n] && colours[n] == picture.rgba[n]) continue;
      throw Error(ErrorCode::kInternal, fmt::format("pixel {}, {} of the picture is wrong",
                                                    n % static_cast<std::size_t>(bench.width),
                                                    n / static_cast<std::size_t>(bench.width)));
    }
    return seen;
  });
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Phase {
  const char* name;
  std::vector<double> seconds;
};

}  // namespace

void write_render_bench(const RenderBench& bench, const std::filesystem::path& path) {
  const auto* const kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                        [&](const NamedKind& k) { return k.kind == bench.scene.kind; });
  const Json json{{"footwall_render_bench", 1},
                  {"width", bench.width},
                  {"height", bench.height},
                  {"threads", bench.threads},
                  {"repeat", bench.repeat},
                  {"group_threshold", json_of_threshold(bench.group_threshold)},
                  {"scene",
                   {{"kind", kind->name},
                    {"file", bench.scene.file.string()},
                    {"dims", bench.scene.dims},
                    {"value", bench.scene.value},
                    {"triangles", bench.scene.triangles},
                    {"pyramid", bench.scene.pyramid}}},
                  {"result", bench.result.string()}};
  write_job_json(json, path, "the path " + bench.scene.file.string() + ": it is not UTF-8");
}

RenderBench read_render_bench(const std::filesystem::path& path) {
  const Json json = read_job_json(path);
  const Error odd(ErrorCode::kFormat, path.string() + " is no render bench of this version",
                  "use footwall bench render");
  try {
    if (json.at("footwall_render_bench") != 1) throw odd;
    RenderBench bench;
    bench.width = json.at("width").get<int>();
    bench.height = json.at("height").get<int>();
    bench.threads = json.at("threads").get<int>();
    bench.repeat = json.at("repeat").get<int>();
    bench.group_threshold = threshold_from(json.at("group_threshold"));
    const Json& scene = json.at("scene");
    const auto* const kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                          [&](const NamedKind& k) { return scene.at("kind") == k.name; });
    if (kind == std::end(kKinds)) throw odd;
    bench.scene.kind = kind->kind;
    bench.scene.file = scene.at("file").get<std::string>();
    bench.scene.dims = scene.at("dims").get<survey::Index>();
    bench.scene.value = scene.at("value").get<float>();
    bench.scene.triangles = scene.at("triangles").get<std::int64_t>();
    bench.scene.pyramid = scene.at("pyramid").get<bool>();
    bench.result = json.at("result").get<std::string>();
    if (bench.threads < 1 || bench.repeat < 1) throw odd;
    return bench;
  } catch (const Json::exception&) {
    throw odd;
  }
}

void run_render_bench(const comm::Communicator& parent, const std::filesystem::path& job_path,
                      const JobContext& context) {
  const RenderBench bench = parent.collectively([&] { return read_render_bench(job_path); });
  comm::Communicator world(parent.get());
  BenchSource source(world, bench.scene, bench.threads);
  const render::Camera camera = world.collectively([&] {
    return render::Camera::look(kAzimuth, kElevation, 1, source.bounds(),
                                static_cast<double>(bench.width) / bench.height, true);
  });
  render::ComposeOptions options{bench.width, bench.height, bench.threads, {}};
  options.groups = group_options(world, bench.group_threshold, bench.threads);
  render::Composer composer;
  render::ComposeReport report;
  Finished picture(
      world.rank() == 0 ? static_cast<std::size_t>(bench.width) * static_cast<std::size_t>(bench.height) : 0);
  double assemble = 0;
  const auto draw = [&] {
    source.prepare(world);
    const render::SurfaceLayer layer = composer.compose(world, source.surfaces(), camera, options, report);
    if (world.rank() != 0) return;
    const double start = omp_get_wtime();
    picture.assemble(layer, bench.threads);
    assemble = omp_get_wtime() - start;
  };

  draw();
  const std::int64_t seen = check_picture(world, source, camera, bench, picture);
  const std::uint64_t right = picture.hash();

  std::vector<double> totals;
  std::vector<Phase> phases{{"extract", {}}, {"group", {}}, {"project", {}}, {"rasterize", {}},
                            {"shade", {}},   {"merge", {}}, {"gather", {}},  {"assemble", {}}};
  for (int n = 0; n < bench.repeat; ++n) {
    world.collectively([&] { context.report(static_cast<double>(n) / bench.repeat, "measure"); });
    const double start = omp_get_wtime();
    draw();
    const double total = omp_get_wtime() - start;
    const render::ComposeReport::Seconds& s = report.seconds;
    const double mine[] = {
        source.extract_seconds(), s.group, s.project, s.rasterize, s.shade, s.merge, s.gather, assemble};
    totals.push_back(world.maximum(total));
    for (std::size_t p = 0; p < phases.size(); ++p) phases[p].seconds.push_back(world.maximum(mine[p]));
    world.collectively([&] {
      if (world.rank() == 0 && picture.hash() != right)
        throw Error(ErrorCode::kInternal, "a repeat gave another picture");
    });
  }

  Json result{{"ranks", world.size()},
              {"threads", bench.threads},
              {"triangles", source.triangles()},
              {"pixels", seen},
              {"picture", to_hex(right)},
              {"seconds", totals},
              {"bytes_sent", world.sum(report.bytes)},
              {"messages", world.sum(report.messages)},
              {"merged_bytes", world.sum(report.merged_bytes)},
              {"merged_pixels", world.sum(report.merged_pixels)},
              {"group_steps", world.maximum(std::int64_t{report.group_steps})}};
  constexpr double kMiB = 1 << 20;
  const auto samples = static_cast<double>(world.maximum(source.samples()));
  result["samples_mib"] =
      source.is_volume() ? Json(samples * static_cast<double>(sizeof(float)) / kMiB) : Json();
  const double pyramid = world.maximum(source.pyramid_seconds().value_or(0));
  result["pyramid_seconds"] = bench.scene.pyramid ? Json(pyramid) : Json();
  for (const Phase& phase : phases) {
    const double seconds = median(phase.seconds);
    result["phases"][phase.name] = seconds;
    result["mtriangles_per_second"][phase.name] =
        seconds > 0 ? Json(static_cast<double>(source.triangles()) / seconds / 1e6) : Json();
  }
  world.collectively([&] {
    if (world.rank() == 0) write_whole_file(bench.result, result.dump(1) + "\n");
  });
}

}  // namespace footwall::session
