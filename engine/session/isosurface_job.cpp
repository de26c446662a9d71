#include "engine/session/isosurface_job.h"

#include <nlohmann/json.hpp>

#include "engine/session/camera_json.h"
#include "engine/session/job_json.h"
#include "storage/base/error.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

Json json_of(const VisibleView& view) {
  return {{"choice", session::json_of(view.choice)},
          {"camera", session::json_of(view.camera)},
          {"placement", session::json_of(view.placement)},
          {"width", view.width},
          {"height", view.height},
          {"colour", view.colour}};
}

VisibleView visible_view_from(const Json& json) {
  VisibleView view;
  view.choice = visible_choice_from(json.at("choice"));
  view.camera = camera_from(json.at("camera"));
  view.placement = placement_from(json.at("placement"));
  view.width = json.at("width").get<int>();
  view.height = json.at("height").get<int>();
  view.colour = json.at("colour").get<render::Rgba>();
  return view;
}

}  // namespace

Json json_of(const IsosurfaceJob& job) {
  Json json{{"footwall_isosurface", 1},
            {"volume", job.volume.string()},
            {"value", job.value},
            {"variant", job.variant},
            {"pillars", job.pillars ? isosurface::text_of(*job.pillars) : "auto"},
            {"coordinates", job.world ? "world" : "index"},
            {"cap", job.cap},
            {"largest", job.largest},
            {"min_area", job.min_area},
            {"velocity", job.velocity ? Json(*job.velocity) : Json()},
            {"visible", job.visible ? json_of(*job.visible) : Json()},
            {"output", job.output.string()},
            {"result", job.result.string()}};
  if (!job.volume_file.empty()) json["volume_file"] = job.volume_file;
  return json;
}

void write_isosurface_job(const IsosurfaceJob& job, const std::filesystem::path& path) {
  write_job_json(
      json_of(job), path,
      "the paths " + job.volume.string() + " and " + job.output.string() + ": they are not both UTF-8",
      "rename them");
}

IsosurfaceJob read_isosurface_job(const std::filesystem::path& path) {
  return isosurface_job_from(read_job_json(path), path.string());
}

IsosurfaceJob isosurface_job_from(const Json& json, const std::string& what) {
  const Error odd(ErrorCode::kFormat, what + " is no isosurface job of this version",
                  "use footwall isosurface");
  try {
    if (json.at("footwall_isosurface") != 1) throw odd;
    IsosurfaceJob job;
    job.volume = json.at("volume").get<std::string>();
    job.value = json.at("value").get<float>();
    job.variant = json.at("variant").get<std::string>();
    const auto pillars = json.at("pillars").get<std::string>();
    if (pillars != "auto") job.pillars = isosurface::parse_interleaving(pillars);
    job.world = json.at("coordinates") == "world";
    job.cap = json.at("cap").get<bool>();
    job.largest = json.at("largest").get<std::uint64_t>();
    job.min_area = json.at("min_area").get<double>();
    if (!json.at("velocity").is_null()) job.velocity = json.at("velocity").get<double>();
    if (!json.at("visible").is_null()) job.visible = visible_view_from(json.at("visible"));
    job.output = json.at("output").get<std::string>();
    job.result = json.at("result").get<std::string>();
    job.volume_file = json.value("volume_file", "");
    return job;
  } catch (const Json::exception&) {
    throw odd;
  }
}

}  // namespace footwall::session
