// The picture of a survey's faults: meshes coloured by a statistic, sections, the survey's box with labelled
// axes, north arrow, colour bars. `footwall render --faults` is this and write_png.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/colour_map.h"
#include "engine/render/picture.h"
#include "engine/render/scene_frame.h"
#include "storage/survey/geometry.h"

namespace footwall::render {

struct FaultMesh {
  std::string name;
  Rgba colour = 0;  // of its outline, name and plain faces; 0 = the next of fault_colour(n)
  std::vector<survey::WorldPoint> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  // One per triangle; NaN = null (hatched grey). Empty, or nothing but NaN: never computed, the fault's plain
  // colour.
  std::vector<double> values;
  // Drawn as thin lines with a dot at each node: where the interpreter picked.
  std::vector<std::vector<survey::WorldPoint>> pillars;
};

struct ShownStatistic {
  std::string title = "amplitude variance";
  std::string unit;                    // "unit²"; may be empty
  std::string note;                    // "run 3, volume amplitude"; may be empty
  const ColourMap* colours = nullptr;  // null: viridis
  // none: 2nd to 98th percentile over all faults; for a diverging map symmetric about 0, 98th of |value|
  std::optional<Range> range;
};

// A section of a volume. axis 0: values are [crossline][sample] of inline number `index`; axis 1:
// [inline][sample]; axis 2: [inline][crossline]. NaN = null. `index` counts lines or samples from 0 (it is
// not a line number).
struct ShownSection {
  int axis = 0;
  std::int64_t index = 0;
  std::vector<float> values;
};

struct SectionStyle {
  std::string title = "amplitude";
  std::string unit;
  const ColourMap* colours = nullptr;  // null: grey
  std::optional<Range> range;  // none: symmetric about 0, 99th percentile of |value| over all sections
};

// From a place to another, scene frame in metres; `up` comes out upwards.
struct LookAt {
  Vec3 eye;
  Vec3 target;
  Vec3 up{0, 0, 1};
};

struct View {
  std::optional<double> azimuth_degrees;  // 0 looks north, clockwise; none = chosen by best_azimuth
  double elevation_degrees = 25;
  double zoom = 1;  // 1 fits the box
  bool perspective = true;
  std::optional<LookAt> look_at;  // then direction and zoom are not looked at
  double exaggeration = 0;        // of heights; 0 = chosen by SceneFrame::pleasing_exaggeration
  double velocity = 0;            // m/s, for time surveys; 0 = not known, 1 ms is drawn as 1 m
};

struct FaultPicture {
  survey::Geometry geometry;
  std::vector<FaultMesh> faults;
  ShownStatistic statistic;
  std::vector<ShownSection> sections;
  SectionStyle section_style;
  // Drawn elsewhere through the same camera (surface_layer.h): here they only have their legend.
  std::vector<LegendEntry> isosurfaces;
  std::string isosurfaces_title = "Isosurfaces";  // of the legend where there are no faults
  View view;
  std::string title;  // usually the project's name; may be empty
  bool mesh_edges = true;
};

// The n-th of a set of colours that differ in lightness as well as hue; starts again after the last.
Rgba fault_colour(std::size_t n);

// Throws Error kInvalid for meshes, values or sections whose sizes do not fit, kUsage for a view that cannot
// be.
struct Composition {
  Scene scene;
  Camera camera;
  SceneFrame frame;
};
Composition compose(const FaultPicture& what, int width, int height);
// compose() and render(). threads: 0 = all.
Picture draw(const FaultPicture& what, int width, int height, int threads);

}  // namespace footwall::render
