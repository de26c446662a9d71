#include "engine/render/fault_picture.h"

#include <fmt/format.h>
#include <iterator>

#include <algorithm>
#include <cmath>

#include "engine/render/axes.h"
#include "engine/render/best_view.h"
#include "engine/render/box_fit.h"
#include "engine/render/fault_contact.h"
#include "engine/render/fault_lines.h"
#include "engine/render/overlay.h"
#include "engine/render/scene_frame.h"
#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr Rgba kSectionFrame = hex(0x8d95a1);
constexpr Rgba kContactRim = hex(0x1b1f25);
constexpr Rgba kContact = hex(0xf4f6f9);
constexpr std::size_t kMostAnchors = 48;

bool has_values(const FaultMesh& fault) {
  return std::any_of(fault.values.begin(), fault.values.end(), [](double v) { return !std::isnan(v); });
}

void check(const FaultPicture& what) {
  for (const FaultMesh& fault : what.faults) {
    try {
      check_indices(fault.triangles, fault.vertices.size());
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("fault {}: {}", fault.name, error.message()), error.hint());
    }
    if (!fault.values.empty() && fault.values.size() != fault.triangles.size()) {
      throw Error(ErrorCode::kInvalid, fmt::format("fault {} has {} faces but {} values", fault.name,
                                                   fault.triangles.size(), fault.values.size()));
    }
  }
  const survey::Index dims = what.geometry.dims();
  for (const ShownSection& section : what.sections) {
    require(section.axis >= 0 && section.axis < 3, "a section's axis is 0, 1 or 2");
    const std::int64_t samples = what.geometry.box().count() / dims[static_cast<std::size_t>(section.axis)];
    if (section.index < 0 || section.index >= dims[static_cast<std::size_t>(section.axis)] ||
        static_cast<std::int64_t>(section.values.size()) != samples) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("section {} on axis {} with {} samples is not one of the survey's {} x {} x {}",
                              section.index, section.axis, section.values.size(), dims[0], dims[1], dims[2]));
    }
  }
}

// One range for all faults, so that a colour means the same on each of them. The middle of a diverging map
// stands for zero.
Range range_of(const FaultPicture& what, const ColourMap& map) {
  if (what.statistic.range) return *what.statistic.range;
  std::vector<double> all;
  for (const FaultMesh& fault : what.faults) all.insert(all.end(), fault.values.begin(), fault.values.end());
  if (map.kind() == ColourMapKind::kSequential) return percentile_range(all).value_or(Range{});
  const std::vector<float> values(all.begin(), all.end());
  return symmetric_range(values, 98).value_or(Range{-1, 1});
}

Range range_of_sections(const FaultPicture& what) {
  if (what.section_style.range) return *what.section_style.range;
  std::vector<float> all;
  for (const ShownSection& section : what.sections)
    all.insert(all.end(), section.values.begin(), section.values.end());
  return symmetric_range(all).value_or(Range{-1, 1});
}

// Places for a fault's name: along its upper border, the middle first.
std::vector<Vec3> name_places(const std::vector<Vec3>& border) {
  std::vector<Vec3> places;
  std::copy_if(border.begin(), border.end(), std::back_inserter(places),
               [](const Vec3& p) { return std::isfinite(p.x + p.y + p.z); });
  if (places.empty()) return places;
  std::stable_sort(places.begin(), places.end(), [](const Vec3& a, const Vec3& b) { return a.z > b.z; });
  places.resize((places.size() + 4) / 5);
  Vec3 mean;
  for (const Vec3& p : places) mean = mean + p * (1.0 / static_cast<double>(places.size()));
  std::stable_sort(places.begin(), places.end(),
                   [&](const Vec3& a, const Vec3& b) { return length(a - mean) < length(b - mean); });
  std::vector<Vec3> spread;
  const std::size_t stride = std::max<std::size_t>(1, places.size() / kMostAnchors);
  for (std::size_t n = 0; n < places.size(); n += stride) spread.push_back(places[n]);
  return spread;
}

void add_fault(Scene& scene, const FaultMesh& fault, const SceneFrame& frame, const FaultPicture& what,
               const ColourMap& map, const Range& range) {
  ColouredMesh mesh;
  std::vector<Vec3> vertices;
  std::vector<survey::IndexPoint> in_index;
  for (const survey::WorldPoint& p : fault.vertices) {
    vertices.push_back(frame.scene_of(p));
    mesh.positions.push_back(static_cast<Vec3f>(vertices.back()));
    in_index.push_back(frame.geometry().index_of(p));
  }
  mesh.triangles = fault.triangles;
  mesh.edges = what.mesh_edges;
  const bool valued = has_values(fault);
  for (std::size_t t = 0; t < fault.triangles.size(); ++t) {
    mesh.face_colours.push_back(valued ? map.colour_of(fault.values[t], range) : fault.colour);
    if (valued) mesh.face_hatched.push_back(std::isnan(fault.values[t]) ? 1 : 0);
  }
  const std::vector<Vec3> border = border_of(vertices, fault.triangles);
  const double s = scene.text_scale;
  scene.lines.push_back({border, 2.4 * s, fault.colour, 0.0012, true});
  for (const ShownSection& section : what.sections) {
    scene.lines.push_back(
        {cut_of(frame, in_index, fault.triangles, section.axis, static_cast<double>(section.index)), 2.2 * s,
         fault.colour, 0.0016, true});
  }
  for (const std::vector<survey::WorldPoint>& pillar : fault.pillars) {
    Polyline line{{}, 1.0 * s, mixed(fault.colour, hex(0xffffff), 0.3), 0.0008, false, 4.4 * s};
    for (const survey::WorldPoint& p : pillar) line.points.push_back(frame.scene_of(p));
    scene.lines.push_back(std::move(line));
  }
  scene.labels.push_back({fault.name, name_places(border), 0, -15 * s, Align::kCentre, 16 * s,
                          mixed(fault.colour, hex(0xffffff), 0.45), true});
  scene.legend.push_back({fault.name, fault.colour});
  scene.meshes.push_back(std::move(mesh));
}

std::string name_of_section(const ShownSection& section, const survey::Geometry& g) {
  if (section.axis == 0) return fmt::format("inline {}", g.inlines.line_of(section.index));
  if (section.axis == 1) return fmt::format("crossline {}", g.crosslines.line_of(section.index));
  return fmt::format("{:.10g} {}", g.z0 + g.interval * static_cast<double>(section.index),
                     name_of(g.vertical_unit));
}

void add_section(Scene& scene, const ShownSection& section, const SceneFrame& frame, const ColourMap& map,
                 const Range& range) {
  const survey::Geometry& g = frame.geometry();
  const auto dims = g.dims();
  const std::size_t row_axis = section.axis == 0 ? 1 : 0;
  const std::size_t column_axis = section.axis == 2 ? 1 : 2;
  const auto at = [&](double row, double column) {
    std::array<double, 3> p{};
    p[static_cast<std::size_t>(section.axis)] = static_cast<double>(section.index);
    p[row_axis] = row;
    p[column_axis] = column;
    return frame.scene_of(survey::IndexPoint{p[0], p[1], p[2]});
  };
  SectionPlane plane;
  plane.origin = at(0, 0);
  plane.along_rows = at(1, 0) - plane.origin;
  plane.along_columns = at(0, 1) - plane.origin;
  plane.rows = static_cast<int>(dims[row_axis]);
  plane.columns = static_cast<int>(dims[column_axis]);
  plane.values = section.values;
  plane.colours = &map;
  plane.range = range;
  const double rows = plane.rows - 0.5;
  const double columns = plane.columns - 0.5;
  const double s = scene.text_scale;
  scene.lines.push_back(
      {{at(-0.5, -0.5), at(rows, -0.5), at(rows, columns), at(-0.5, columns), at(-0.5, -0.5)},
       1.4 * s,
       kSectionFrame,
       0.0008,
       false});
  std::vector<Vec3> places;
  for (const double share : {0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95})
    places.push_back(at(-0.5 + share * (rows + 0.5), -0.5));
  scene.labels.push_back(
      {name_of_section(section, g), places, 0, -17 * s, Align::kCentre, 15 * s, hex(0xd6dae0), false});
  scene.sections.push_back(std::move(plane));
}

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  std::string all;
  for (const std::string& part : parts) {
    if (!part.empty()) all += (all.empty() ? "" : std::string(separator)) + part;
  }
  return all;
}

std::string summary_of(const SceneFrame& frame, double velocity) {
  const survey::Geometry& g = frame.geometry();
  std::string heights = frame.exaggeration() == 1 ? "" : fmt::format("z × {:.4g}", frame.exaggeration());
  if (g.domain == survey::Domain::kTime) {
    heights =
        joined({heights, velocity > 0 ? fmt::format("at {:.6g} m/s", velocity) : "1 ms drawn as 1 m"}, ", ");
  }
  return joined(
      {fmt::format("inlines {}–{}", g.inlines.first, g.inlines.last()),
       fmt::format("crosslines {}–{}", g.crosslines.first, g.crosslines.last()),
       fmt::format("{:.10g}–{:.10g} {}", g.z0, g.z0 + g.interval * static_cast<double>(g.samples - 1),
                   name_of(g.vertical_unit)),
       heights},
      " · ");
}

Surface surface_of(const FaultMesh& fault, const SceneFrame& frame) {
  Surface surface{{}, fault.triangles};
  for (const survey::WorldPoint& p : fault.vertices)
    surface.positions.push_back(static_cast<Vec3f>(frame.scene_of(p)));
  return surface;
}

Surface surface_of(const ShownSection& section, const SceneFrame& frame) {
  const survey::Index dims = frame.geometry().dims();
  Surface surface{{}, {{0, 1, 3}, {0, 3, 2}}};
  for (unsigned corner = 0; corner < 4; ++corner) {
    std::array<double, 3> p{};
    unsigned bit = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[axis] = static_cast<int>(axis) == section.axis ? static_cast<double>(section.index)
                : (corner >> bit++ & 1U) != 0          ? static_cast<double>(dims[axis]) - 0.5
                                                       : -0.5;
    }
    surface.positions.push_back(static_cast<Vec3f>(frame.scene_of(survey::IndexPoint{p[0], p[1], p[2]})));
  }
  return surface;
}

void add_contacts(Scene& scene, const FaultPicture& what, const SceneFrame& frame) {
  std::vector<std::vector<Vec3>> vertices;
  std::vector<Triangles> surfaces;
  for (const FaultMesh& fault : what.faults) {
    std::vector<Vec3>& placed = vertices.emplace_back();
    for (const survey::WorldPoint& p : fault.vertices) placed.push_back(frame.scene_of(p));
  }
  for (std::size_t n = 0; n < vertices.size(); ++n)
    surfaces.push_back({vertices[n], what.faults[n].triangles});
  std::vector<Vec3> contacts = contacts_of(surfaces);
  if (contacts.empty()) return;
  // Seen on bright faces by its rim, on dark ones by its middle.
  const double s = scene.text_scale;
  scene.lines.push_back({contacts, 3.6 * s, kContactRim, 0.0003, true});
  scene.lines.push_back({std::move(contacts), 1.7 * s, kContact, 0.002, true});
}

double chosen_azimuth(const FaultPicture& what, const SceneFrame& frame) {
  std::vector<Surface> faults;
  std::vector<Surface> sections;
  for (const FaultMesh& fault : what.faults) faults.push_back(surface_of(fault, frame));
  for (const ShownSection& section : what.sections) sections.push_back(surface_of(section, frame));
  return best_azimuth(frame, faults, sections, what.view.elevation_degrees, what.view.perspective);
}

// What title and panels leave of the picture. In tiny pictures they overlap the box rather than squeeze it.
Room free_room(const FaultPicture& what, int width, int height, double scale) {
  const bool panels = !what.faults.empty() || !what.sections.empty() || !what.isosurfaces.empty();
  const double right = std::min((panels ? kPanelWidth + 12 : 20) * scale, 0.5 * width);
  return {std::min(20 * scale, 0.1 * width), std::min(98 * scale, 0.25 * height), width - right,
          height - std::min(18 * scale, 0.1 * height)};
}

Camera camera_of(const FaultPicture& what, const SceneFrame& frame, int width, int height, double scale) {
  if (what.view.look_at) {
    const auto& [eye, target, up] = *what.view.look_at;
    return Camera::look_at(eye, target, up, frame.corners(), static_cast<double>(width) / height,
                           what.view.perspective);
  }
  const double azimuth = what.view.azimuth_degrees ? *what.view.azimuth_degrees : chosen_azimuth(what, frame);
  return fitted_camera(frame, {azimuth, what.view.elevation_degrees, what.view.perspective}, what.view.zoom,
                       free_room(what, width, height, scale), width, height, scale);
}

}  // namespace

Rgba fault_colour(std::size_t n) {
  static constexpr Rgba kColours[] = {hex(0xe06c6c), hex(0x4aa3df), hex(0xf0c35a), hex(0xb58ee0),
                                      hex(0x6fcf8e), hex(0xf2a0c8), hex(0x2f7f8f), hex(0xd9d3c7),
                                      hex(0xa4542e), hex(0x8792f5)};
  return kColours[n % std::size(kColours)];
}

Composition compose(const FaultPicture& what, int width, int height) {
  if (width < 1 || height < 1)
    throw Error(ErrorCode::kUsage, fmt::format("a picture of {} x {} pixels cannot be drawn", width, height));
  const double velocity = what.geometry.domain == survey::Domain::kTime ? what.view.velocity : 0;
  const double exaggeration = what.view.exaggeration == 0
                                  ? SceneFrame::pleasing_exaggeration(what.geometry, velocity)
                                  : what.view.exaggeration;
  const SceneFrame frame(what.geometry, exaggeration, velocity);
  check(what);

  Composition made{{}, {}, frame};
  Scene& scene = made.scene;
  scene.text_scale = std::max(0.4, std::min(width / 1600.0, height / 1000.0));
  const bool coloured = std::any_of(what.faults.begin(), what.faults.end(), has_values);
  made.camera = camera_of(what, frame, width, height, scene.text_scale);

  const ColourMap& map =
      what.statistic.colours != nullptr ? *what.statistic.colours : ColourMap::named("viridis");
  const Range range = range_of(what, map);
  add_axes(scene, frame, made.camera, width, height);
  bool undefined = false;
  for (std::size_t n = 0; n < what.faults.size(); ++n) {
    FaultMesh fault = what.faults[n];
    if (fault.colour == 0) fault.colour = fault_colour(n);
    undefined = undefined || (has_values(fault) && std::any_of(fault.values.begin(), fault.values.end(),
                                                               [](double v) { return std::isnan(v); }));
    add_fault(scene, fault, frame, what, map, range);
  }
  add_contacts(scene, what, frame);
  const ColourMap& grey =
      what.section_style.colours != nullptr ? *what.section_style.colours : ColourMap::named("grey");
  const Range section_range = range_of_sections(what);
  for (const ShownSection& section : what.sections) add_section(scene, section, frame, grey, section_range);
  if (!what.sections.empty())
    scene.bars.push_back({what.section_style.title, what.section_style.unit, &grey, section_range, false});
  if (coloured) {
    scene.bars.push_back({what.statistic.title, joined({what.statistic.unit, what.statistic.note}, "\n"),
                          &map, range, undefined});
  }
  scene.legend.insert(scene.legend.end(), what.isosurfaces.begin(), what.isosurfaces.end());
  if (!what.isosurfaces.empty())
    scene.legend_title = what.faults.empty() ? what.isosurfaces_title : "Faults, isosurfaces";
  scene.orientation_axes = !what.isosurfaces.empty();
  scene.title = what.title;
  scene.subtitle = summary_of(frame, velocity);
  return made;
}

Picture draw(const FaultPicture& what, int width, int height, int threads) {
  const Composition made = compose(what, width, height);
  return render(made.scene, made.camera, width, height, threads);
}

}  // namespace footwall::render
