#include "engine/tasks/render_faults.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/render/fault_picture.h"
#include "engine/tasks/face_tables.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/render_camera.h"
#include "engine/tasks/section_plane.h"
#include "engine/tasks/statistics.h"
#include "engine/tasks/triangulate.h"
#include "engine/tasks/visible.h"
#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/png.h"
#include "storage/formats/tiff.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {
namespace {

render::ShownSection section_of(const volume::VolumeReader& reader, const project::VolumeRecord& volume,
                                const SectionPlane& plane) {
  if (volume.origin != survey::Index{0, 0, 0}) {
    throw Error(
        ErrorCode::kUnsupported,
        fmt::format("sections of '{}', which covers a part of the survey, cannot be drawn yet", volume.name),
        "choose a volume of the whole survey with --volume");
  }
  survey::Box box = {{0, 0, 0}, volume.dims};
  const auto axis = static_cast<std::size_t>(plane.axis);
  box.lo[axis] = plane.index;
  box.hi[axis] = plane.index + 1;
  render::ShownSection section{plane.axis, plane.index,
                               std::vector<float>(static_cast<std::size_t>(box.count()))};
  reader.read(box, section.values);
  return section;
}

// A face without voxels has no colour, whatever its statistic's convention.
std::vector<double> shown_values(const formats::MeshTable& table, const std::string& statistic) {
  std::vector<double> values = values_of(table, statistic);
  const std::vector<double> counts = counts_of(table);
  for (std::size_t f = 0; f < counts.size(); ++f) {
    if (counts[f] == 0) values[f] = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

// Where the interpreter picked; what was interpolated between shows in the surface.
std::vector<std::vector<survey::WorldPoint>> picked_pillars(const project::Project& project,
                                                            std::int64_t fault) {
  std::vector<std::vector<survey::WorldPoint>> lines;
  for (const survey::Pillar& pillar : project.pillars(fault)) {
    if (pillar.kind == survey::PillarKind::kInterpolated) continue;
    lines.emplace_back();
    for (const survey::PillarNode& node : pillar.nodes) lines.back().push_back(node.position);
  }
  return lines;
}

// "amplitude^2" as it is written by hand.
std::string raised(std::string unit) {
  for (const auto& [plain, sign] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}}) {
    if (const auto at = unit.find(plain); at != std::string::npos) unit.replace(at, 2, sign);
  }
  return unit;
}

void add_faults(const project::Project& project, const RenderOptions& options, render::FaultPicture& picture,
                Rendered& done) {
  const auto run = chosen_run(project, options.run, options.statistic);
  const FaceTables faces = run ? face_tables(project, "", run->id, Coordinates::kWorld)
                               : present_faces(project, "", Coordinates::kWorld);
  std::size_t n = 0;
  for (const formats::MeshTable& table : faces.tables) {
    render::FaultMesh mesh;
    mesh.name = table.fault;
    mesh.colour = render::fault_colour(n++);
    mesh.vertices = table.vertices;
    mesh.triangles = table.triangles;
    if (faces.run) mesh.values = shown_values(table, options.statistic);
    mesh.pillars = picked_pillars(project, project.fault(table.fault).id);
    done.faces += static_cast<std::int64_t>(table.triangles.size());
    picture.faults.push_back(std::move(mesh));
  }
  if (faces.tables.empty()) {
    throw Error(ErrorCode::kInvalid, "no fault has a mesh yet", "footwall triangulate makes them");
  }
  if (!faces.run)
    done.notices.emplace_back(
        "no statistics yet: faults are drawn in their plain colours (footwall extract computes them)");
  for (const std::string& name : faces.stale)
    done.notices.push_back(name + " was edited since its colours were computed");

  const auto known = known_statistics(project);
  const auto row =
      std::find_if(known.begin(), known.end(), [&](const auto& r) { return r.name == options.statistic; });
  if (row == known.end())
    throw Error(ErrorCode::kUsage, fmt::format("there is no statistic '{}'", options.statistic),
                "footwall faces lists them");
  picture.statistic.title = row->name == "variance" ? "amplitude variance" : row->name;
  picture.statistic.unit = raised(unit_of(*row));
  picture.statistic.colours =
      &render::ColourMap::named(options.colours.empty() ? row->colour_map : options.colours);
  if (options.range) picture.statistic.range = render::Range{(*options.range)[0], (*options.range)[1]};
  if (faces.run) {
    picture.statistic.note = faces.run->volume.empty()
                                 ? faces.run->name
                                 : fmt::format("{}, volume {}", faces.run->name, faces.run->volume);
  }
}

// Says of each isosurface that a budget ended.
void add_end_notices(const RenderOptions& options, Rendered& done) {
  const auto result = nlohmann::json::parse(done.engine_json);
  for (std::size_t n = 0; n < done.isosurfaces.size(); ++n) {
    std::string notice =
        end_notice(done.isosurfaces[n], *options.drawing.visible, result.at("isosurfaces").at(n));
    if (!notice.empty()) done.notices.push_back(std::move(notice));
  }
}

// Before the engine is started for a picture that nobody could draw.
void check_size(const RenderOptions& options) {
  if (options.width >= 1 && options.height >= 1 && options.width <= render::kLargestPicture &&
      options.height <= render::kLargestPicture)
    return;
  throw Error(ErrorCode::kUsage,
              fmt::format("a picture of {} x {} pixels cannot be drawn", options.width, options.height),
              fmt::format("give 1 to {} pixels each way", render::kLargestPicture));
}

}  // namespace

Rendered render_faults(const project::Project& project, const RenderOptions& options,
                       const std::filesystem::path& out, const JobContext& job) {
  render::FaultPicture picture;
  picture.geometry = required_survey(project, "a picture");
  picture.title = project.path().stem().string();
  picture.view.azimuth_degrees = options.azimuth;
  picture.view.elevation_degrees = options.elevation;
  picture.view.zoom = options.zoom;
  picture.view.exaggeration = options.exaggeration;
  picture.view.velocity = options.velocity;
  if (!options.camera.empty()) take_camera(project, options.camera, picture.view);
  Rendered done;
  done.view = picture.view;
  job.report(0.05, "read");
  if (options.faults) add_faults(project, options, picture, done);
  if (!options.sections.empty()) {
    const project::VolumeRecord volume = project.volume(options.volume);
    const volume::VolumeReader reader = open_volume(project, volume);
    for (const std::string& words : options.sections) {
      picture.sections.push_back(section_of(reader, volume, section_plane(words, picture.geometry)));
    }
    picture.section_style.title = volume.name;
  }
  const std::vector<WantedIsosurface> wanted = isosurfaces_from(project, options.isosurfaces);
  const bool wanted_of_one_volume = std::all_of(
      wanted.begin(), wanted.end(),
      [&](const WantedIsosurface& each) { return each.volume.name == wanted.front().volume.name; });
  // In a legend of one volume its name is the title.
  if (!wanted.empty() && wanted_of_one_volume) picture.isosurfaces_title = wanted.front().volume.name;
  for (const WantedIsosurface& each : wanted) {
    const bool values_do = wanted_of_one_volume && picture.faults.empty();
    picture.isosurfaces.push_back({values_do ? text::shortest(each.value) : each.name, each.colour});
    done.isosurfaces.push_back(each.name);
  }
  check_size(options);
  const render::Composition made = render::compose(picture, options.width, options.height);
  DrawnIsosurfaces surfaces;
  if (!wanted.empty()) {
    PassImages images(options.pass_images);
    DrawingOptions drawing = options.drawing;
    if (images.are_wanted()) {
      drawing.after_passes = [&](const session::VisibleChoice& choice, int count) {
        images.write(choice, count, made, options.width, options.height, options.threads, job.part(0.6, 0.7));
      };
    }
    surfaces = draw_isosurfaces(project, wanted, made.frame, made.camera, options.width * render::kSamples,
                                options.height * render::kSamples, drawing,
                                job.part(0.2, images.are_wanted() ? 0.6 : 0.7));
    done.pass_images = images.paths();
    done.triangles = surfaces.triangles;
    done.engine_json = surfaces.result_json;
    if (options.drawing.visible) add_end_notices(options, done);
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      if (surfaces.triangles[n] > 0) continue;
      done.notices.push_back(fmt::format("{} has no triangles{}: the volume's values are {:.6g} to {:.6g}",
                                         wanted[n].name, options.drawing.visible ? " that can be seen" : "",
                                         wanted[n].volume.min, wanted[n].volume.max));
    }
  }
  job.report(0.7, "draw");
  const render::Picture drawn =
      render::render(made.scene, made.camera, options.width, options.height, options.threads,
                     wanted.empty() ? nullptr : &surfaces.layer, job);
  job.report(0.9, "write");
  formats::write_png(out, drawn.width, drawn.height, drawn.rgba);
  if (!options.depth.empty()) formats::write_tiff(options.depth, drawn.width, drawn.height, drawn.depth);
  return done;
}

}  // namespace footwall::tasks
