#include "engine/session/render_job.h"

#include <omp.h>

#include <map>
#include <nlohmann/json.hpp>

#include "engine/session/camera_json.h"
#include "engine/session/group_options.h"
#include "engine/session/isosurface_picture.h"
#include "engine/session/job_json.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

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
  std::map<std::filesystem::path, DrawnVolume> volumes;
  const auto volume_of = [&](const std::filesystem::path& path) -> DrawnVolume& {
    return volumes.try_emplace(path, world, path).first->second;
  };
  AfterPass after_pass;
  if (job.visible && !job.visible->pass_layers.empty()) {
    after_pass = [&](int pass, const render::SurfaceLayer& layer) {
      world.collectively([&] {
        if (world.rank() == 0) layer.write(job.visible->pass_layer(pass));
      });
    };
  }
  Json result;
  const render::SurfaceLayer layer = draw_isosurfaces(world, job, volume_of, context, after_pass, result);
  world.collectively([&] {
    context.report(0.95, "write");
    if (world.rank() != 0) return;
    layer.write(job.layer);
    result["seconds"]["total"] = omp_get_wtime() - start;
    result["layer_bytes"] = layer.bytes();
    write_whole_file(job.result, result.dump(1) + "\n");
  });
}

}  // namespace footwall::session
