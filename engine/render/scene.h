// What a picture can show. Positions are in the scene frame; a picture's colours are RGBA8.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/render/colour.h"
#include "engine/render/colour_map.h"
#include "engine/render/rasterizer.h"
#include "engine/render/vector.h"

namespace footwall::render {

// A surface with one colour per face. Triangles with a vertex that is not finite are skipped.
struct ColouredMesh {
  std::vector<Vec3f> positions;
  std::vector<TriangleIndices> triangles;
  std::vector<Rgba> face_colours;          // one per triangle
  std::vector<std::uint8_t> face_hatched;  // one per triangle, or none: 1 = hatched (no value to show)
  bool lit = true;                         // headlight with soft ambient; back faces a shade darker
  bool edges = true;                       // thin darker triangle edges, where triangles are large enough
};

// A plane of samples: texel (a, b) = values[a * columns + b] is centred at origin + a * along_rows + b *
// along_columns and fills half a step to each side. NaN shows ColourMap::kUndefined.
struct SectionPlane {
  Vec3 origin;
  Vec3 along_rows;
  Vec3 along_columns;
  int rows = 0;
  int columns = 0;
  std::vector<float> values;
  const ColourMap* colours = nullptr;  // must outlive the picture's making
  Range range;
};

// A line in space, of constant width in the picture, hidden by what is in front of it.
struct Polyline {
  std::vector<Vec3> points;
  double width = 1;  // pixels of the finished picture
  Rgba colour = hex(0xffffff);
  double lift = 0.001;  // drawn this much nearer (window depth), so that it shows on the surface it lies in
  bool pairs = false;   // points 2n and 2n + 1 are segments of their own
  double dots = 0;      // diameter of a round dot on each point; 0 = none
};

enum class Align : std::uint8_t { kLeft, kCentre, kRight };

// Text that stands at a place in space: at the first of `anchors` that is seen (not hidden, not crowded by an
// earlier label), else nowhere.
struct Label {
  std::string text;  // UTF-8
  std::vector<Vec3> anchors;
  double shift_x = 0;  // from the anchor to the text's reference point, pixels right and down
  double shift_y = 0;
  Align align = Align::kCentre;
  double size = 13;  // pixels
  Rgba colour = hex(0xd6dae0);
  bool bold = false;
};

// A colour bar of the panel in the picture's lower right corner.
struct ColourBar {
  std::string title;  // "amplitude variance"
  std::string note;   // below it, wrapped; '\n' starts a line: unit, state
  const ColourMap* colours = nullptr;
  Range range;
  bool has_undefined = false;  // adds a hatched swatch "no value"
};

struct LegendEntry {
  std::string name;
  Rgba colour = 0;
};

struct Scene {
  std::vector<ColouredMesh> meshes;
  std::vector<SectionPlane> sections;
  std::vector<Polyline> lines;
  std::vector<Label> labels;  // in the order of their importance
  std::vector<ColourBar> bars;
  std::vector<LegendEntry> legend;
  std::string legend_title = "Faults";
  std::string title;
  std::string subtitle;
  bool north_arrow = true;
  bool orientation_axes = false;  // east, north and up in the lower left corner; instead of the arrow
  double text_scale = 1;          // of panels, title and arrow; 1 suits a picture of 1600 x 1000
  Rgba background_top = hex(0x262b33);
  Rgba background_bottom = hex(0x14171b);
};

}  // namespace footwall::render
