#include "engine/session/render_job.h"

#include <omp.h>

#include <nlohmann/json.hpp>

#include "engine/isosurface/parallel/choose_pillars.h"
#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/render/composite/compose.h"
#include "engine/session/camera_json.h"
#include "engine/session/drawn_pieces.h"
#include "engine/session/group_options.h"
#include "engine/session/job_json.h"
#include "engine/session/visible_render.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

// What a rank has of each isosurface.
struct Extracted {
  isosurface::Extraction extraction;
  std::uint64_t first_id = 0;
};

Extracted extract_one(comm::Communicator& world, const RenderJob& job, const RenderJob::Isosurface& wanted,
                      const JobContext& context) {
  isosurface::StoredSamples samples(world, wanted.volume);
  const auto cut = world.collectively([&] {
    return job.interleave == "auto" ? isosurface::choose_interleaving(samples.info().dims, world.size(),
                                                                      samples.bricks(), wanted.value, true)
                                    : isosurface::parse_interleaving(job.interleave);
  });
  const isosurface::Pillars pillars(samples.info().dims, world.size(), cut);
  isosurface::ParallelOptions options;
  options.threads = job.threads;
  options.bricks = &samples.bricks();
  Extracted made;
  isosurface::extract_parallel(world, pillars, samples.field_of(), wanted.value, options, context,
                               made.extraction);
  return made;
}

}  // namespace

Json json_of(const RenderJob& job) {
  Json json{{"footwall_render", 1},
            {"width", job.width},
            {"height", job.height},
            {"threads", job.threads},
            {"group_threshold", json_of_threshold(job.group_threshold)},
            {"interleave", job.interleave},
            {"camera", json_of(job.camera)},
            {"visible", job.visible ? json_of(*job.visible) : Json()},
            {"layer", job.layer.string()},
            {"result", job.result.string()}};
  for (const RenderJob::Isosurface& surface : job.isosurfaces) {
    json["isosurfaces"].push_back({{"volume", surface.volume.string()},
                                   {"value", surface.value},
                                   {"colour", surface.colour},
                                   {"placement", json_of(surface.placement)}});
  }
  return json;
}

void write_render_job(const RenderJob& job, const std::filesystem::path& path) {
  write_job_json(json_of(job), path, "the path " + job.layer.string() + " or a volume's: it is not UTF-8");
}

RenderJob read_render_job(const std::filesystem::path& path) {
  return render_job_from(read_job_json(path), path.string());
}

RenderJob render_job_from(const Json& json, const std::string& what) {
  const Error odd(ErrorCode::kFormat, what + " is no render job of this version", "use footwall render");
  try {
    if (json.at("footwall_render") != 1) throw odd;
    RenderJob job;
    job.width = json.at("width").get<int>();
    job.height = json.at("height").get<int>();
    job.threads = json.at("threads").get<int>();
    job.group_threshold = threshold_from(json.at("group_threshold"));
    job.interleave = json.at("interleave").get<std::string>();
    job.camera = camera_from(json.at("camera"));
    if (!json.at("visible").is_null()) job.visible = visible_choice_from(json.at("visible"));
    job.layer = json.at("layer").get<std::string>();
    job.result = json.at("result").get<std::string>();
    if (job.threads < 1) throw odd;
    for (const Json& each : json.at("isosurfaces")) {
      RenderJob::Isosurface& surface = job.isosurfaces.emplace_back();
      surface.volume = each.at("volume").get<std::string>();
      surface.value = each.at("value").get<float>();
      surface.colour = each.at("colour").get<render::Rgba>();
      surface.placement = placement_from(each.at("placement"));
    }
    return job;
  } catch (const Json::exception&) {
    throw odd;
  }
}

void run_render(const comm::Communicator& parent, const std::filesystem::path& job_path,
                const JobContext& context) {
  run_render(parent, parent.collectively([&] { return read_render_job(job_path); }), context);
}

void run_render(const comm::Communicator& parent, const RenderJob& job, const JobContext& context) {
  const double start = omp_get_wtime();
  comm::Communicator world(parent.get());
  if (job.visible) {
    run_visible_render(world, job, context);
    return;
  }

  std::vector<Extracted> extracted;
  std::uint64_t triangles = 0;
  Json counts = Json::array();
  for (std::size_t n = 0; n < job.isosurfaces.size(); ++n) {
    const auto share = static_cast<double>(job.isosurfaces.size());
    const auto at = static_cast<double>(n);
    extracted.push_back(
        extract_one(world, job, job.isosurfaces[n], context.part(0.7 * at / share, 0.7 * (at + 1) / share)));
    extracted.back().first_id = triangles;
    triangles += extracted.back().extraction.triangles;
    counts.push_back({{"triangles", extracted.back().extraction.triangles}});
  }
  DrawnPieces drawn;
  world.collectively([&] {
    for (std::size_t n = 0; n < extracted.size(); ++n) {
      drawn.add(extracted[n].extraction.pieces, extracted[n].first_id, job.isosurfaces[n].colour,
                job.isosurfaces[n].placement);
    }
    context.report(0.75, "draw");
  });
  render::ComposeOptions options{job.width, job.height, job.threads, {}};
  options.groups = group_options(world, job.group_threshold, job.threads);
  render::ComposeReport report;
  render::Composer composer;
  const render::SurfaceLayer layer =
      composer.compose(world, drawn.surfaces(), job.camera, options, report, context.part(0.75, 0.95));

  double read = 0;
  double busy = 0;
  for (const Extracted& each : extracted) {
    read += each.extraction.read_seconds;
    busy += each.extraction.busy_seconds;
  }
  Json seconds;
  const auto slowest = [&](const char* phase, double mine) { seconds[phase] = world.maximum(mine); };
  slowest("read", read);
  slowest("extract", busy);
  slowest("group", report.seconds.group);
  slowest("project", report.seconds.project);
  slowest("rasterize", report.seconds.rasterize);
  slowest("shade", report.seconds.shade);
  slowest("merge", report.seconds.merge);
  slowest("gather", report.seconds.gather);
  Json result{{"ranks", world.size()},
              {"isosurfaces", counts},
              {"bytes_sent", world.sum(report.bytes)},
              {"messages", world.sum(report.messages)},
              {"merged_bytes", world.sum(report.merged_bytes)},
              {"merged_pixels", world.sum(report.merged_pixels)}};
  world.collectively([&] {
    context.report(0.95, "write");
    if (world.rank() != 0) return;
    layer.write(job.layer);
    seconds["total"] = omp_get_wtime() - start;
    result["seconds"] = seconds;
    result["layer_bytes"] = layer.bytes();
    write_whole_file(job.result, result.dump(1) + "\n");
  });
}

}  // namespace footwall::session
