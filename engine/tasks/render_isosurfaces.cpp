#include "engine/tasks/render_isosurfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/session/private_folder.h"
#include "engine/session/render_job.h"
#include "engine/tasks/job_home.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/visible.h"
#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

struct NamedColour {
  std::string_view name;
  render::Rgba colour;
};
constexpr NamedColour kColours[] = {
    {"sand", render::hex(0xe0b070)},  {"teal", render::hex(0x3fb0a8)},   {"rose", render::hex(0xd9788c)},
    {"blue", render::hex(0x5b8fd6)},  {"green", render::hex(0x74b860)},  {"violet", render::hex(0xa07fd0)},
    {"red", render::hex(0xd8503f)},   {"orange", render::hex(0xe58a3c)}, {"yellow", render::hex(0xe6cf4f)},
    {"white", render::hex(0xeef0f2)}, {"grey", render::hex(0x9aa2ad)},   {"brown", render::hex(0x9a6a45)},
};
constexpr std::size_t kDefaults = 6;  // of them are taken in turn

render::Rgba colour_from(std::string_view word) {
  for (const NamedColour& each : kColours) {
    if (word == each.name) return each.colour;
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::uint32_t rgb = 0;
  bool is_hex = word.size() == 7 && word[0] == '#';
  for (std::size_t n = 1; is_hex && n < word.size(); ++n) {
    const char lower = word[n] >= 'A' && word[n] <= 'F' ? static_cast<char>(word[n] - 'A' + 'a') : word[n];
    const std::size_t digit = kDigits.find(lower);
    is_hex = digit != std::string_view::npos;
    rgb = rgb * 16 + static_cast<std::uint32_t>(digit);
  }
  if (is_hex) return render::hex(rgb);
  std::string names;
  for (const NamedColour& each : kColours) names += (names.empty() ? "" : ", ") + std::string(each.name);
  throw Error(ErrorCode::kUsage, fmt::format("there is no colour '{}'", word),
              "write #rrggbb, or one of: " + names);
}

WantedIsosurface isosurface_from(const project::Project& project, const std::string& words,
                                 std::size_t number) {
  // A volume's name may hold anything but what comes last.
  const std::size_t equals = words.rfind('=');
  const Error wrong(ErrorCode::kUsage, fmt::format("--isosurface {} is no isosurface", words),
                    "write VOLUME=VALUE or VOLUME=VALUE,COLOUR, as amplitude=0.25,teal");
  if (equals == std::string::npos || equals == 0) throw wrong;
  const std::vector<std::string_view> parts = text::split(std::string_view(words).substr(equals + 1), ',');
  const auto value = text::number(parts[0]);
  if (!value || parts.size() > 2 || !std::isfinite(static_cast<float>(*value))) throw wrong;
  WantedIsosurface wanted;
  wanted.volume = present_volume(project, words.substr(0, equals));
  wanted.value = *value;
  wanted.colour = parts.size() == 2 ? colour_from(parts[1]) : isosurface_colour(number);
  wanted.name = fmt::format("{} = {:.6g}", wanted.volume.name, *value);
  return wanted;
}

}  // namespace

render::Rgba isosurface_colour(std::size_t n) {
  return kColours[n % kDefaults].colour;
}

render::Placement placement_of(const project::VolumeRecord& volume, const render::SceneFrame& frame) {
  const auto at = [&](double i, double j, double k) {
    return frame.scene_of(survey::IndexPoint{static_cast<double>(volume.origin[0]) + i,
                                             static_cast<double>(volume.origin[1]) + j,
                                             static_cast<double>(volume.origin[2]) + k});
  };
  render::Placement placement;
  placement.shift = at(0, 0, 0);
  const render::Vec3 axes[] = {at(1, 0, 0) - placement.shift, at(0, 1, 0) - placement.shift,
                               at(0, 0, 1) - placement.shift};
  for (std::size_t n = 0; n < 3; ++n) {
    placement.linear[n] = axes[n].x;
    placement.linear[3 + n] = axes[n].y;
    placement.linear[6 + n] = axes[n].z;
  }
  return placement;
}

std::vector<WantedIsosurface> isosurfaces_from(const project::Project& project,
                                               const std::vector<std::string>& words) {
  std::vector<WantedIsosurface> wanted;
  wanted.reserve(words.size());
  for (const std::string& each : words) wanted.push_back(isosurface_from(project, each, wanted.size()));
  return wanted;
}

DrawnIsosurfaces draw_isosurfaces(const project::Project& project,
                                  const std::vector<WantedIsosurface>& wanted,
                                  const render::SceneFrame& frame, const render::Camera& camera, int width,
                                  int height, const DrawingOptions& options, const JobContext& context) {
  const session::PrivateFolder folder(home_of_job(project));
  session::RenderJob job;
  job.width = width;
  job.height = height;
  job.threads = options.launch.threads > 0 ? options.launch.threads : session::default_threads();
  job.group_threshold = options.group_threshold;
  job.camera = camera;
  job.visible = options.visible;
  if (job.visible && options.after_passes) job.visible->pass_layers = folder.path() / "pass";
  job.layer = folder.path() / "layer";
  job.result = folder.path() / "result.json";
  for (const WantedIsosurface& each : wanted) {
    job.isosurfaces.push_back({std::filesystem::absolute(project.volume_path(each.volume)),
                               static_cast<float>(each.value), each.colour,
                               placement_of(each.volume, frame)});
  }
  const std::filesystem::path job_file = folder.path() / "RENDER.json";
  session::write_render_job(job, job_file);
  DrawnIsosurfaces drawn;
  drawn.result_json =
      session::run_engine(options.launch, {{"render", job_file.string()}, job.result}, context);
  drawn.layer = render::SurfaceLayer::read(job.layer);
  nlohmann::json result = nlohmann::json::parse(drawn.result_json);
  for (nlohmann::json& each : result.at("isosurfaces")) {
    drawn.triangles.push_back(each.at("triangles").get<std::int64_t>());
    if (job.visible) count_pixels(each);
  }
  if (!job.visible) return drawn;
  drawn.result_json = result.dump();
  if (options.after_passes) options.after_passes(*job.visible, result.at("pass_layers").get<int>());
  return drawn;
}

}  // namespace footwall::tasks
