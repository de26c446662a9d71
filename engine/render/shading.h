// From "what is seen here" to a colour: each primitive of a scene has a number, and each number a way to be
// coloured.
#pragma once
#include <span>
#include <vector>

#include "engine/render/camera.h"
#include "engine/render/rasterizer.h"
#include "engine/render/scene.h"

namespace footwall::render {

// The samples that a scene is drawn with: `per_pixel` across and down each pixel of the finished picture.
struct SampleGrid {
  int width = 0;  // samples across the whole picture
  int height = 0;
  int per_pixel = 1;
};

// A scene as the rasterizer takes it: vertices projected once, lines made triangles, primitives numbered in
// the order meshes, sections, lines. The scene must outlive it.
class PreparedScene {
 public:
  // Throws Error kInvalid for meshes, sections or lines whose parts do not fit together.
  PreparedScene(const Scene& scene, const Camera& camera, const SampleGrid& grid, int threads);

  void rasterize_into(VisibilityBuffer& window) const;
  // The colour of primitive `id` at sample (x, y); id is one that rasterize_into() drew there.
  Rgba colour_at(PrimitiveId id, int x, int y) const;

 private:
  struct Mesh {
    const ColouredMesh* source;
    PrimitiveId first;
    std::vector<ScreenVertex> vertices;
    std::vector<Rgba> shades;       // face colours in the scene's light
    std::vector<float> edge_shade;  // how much darker the face's edges are, 0 for small ones
  };
  struct Section {
    const SectionPlane* source;
    PrimitiveId first;
    std::array<double, 9> texel_of;  // homogeneous: sample (x, y, 1) -> (row, column, 1)
    bool seen = false;               // false: edge-on
    bool squares = false;            // texels are shown as they are, else interpolated
  };
  // Where a sample lies in a section, and how many texels one step between samples passes over, down the rows
  // and along the columns.
  struct Texel {
    double row, column, row_step, column_step;
  };
  struct Ribbon {
    std::array<ScreenVertex, 4> corners;
    PrimitiveId id;
  };

  void add_mesh(const ColouredMesh& mesh, const Camera& camera, int threads);
  void add_section(const SectionPlane& section, const Camera& camera);
  void add_line(const Polyline& line, const Camera& camera);
  void add_segment(Vec4 a, Vec4 b, const Polyline& line, PrimitiveId id);
  void add_dot(const Vec4& at, const Polyline& line, PrimitiveId id);
  Rgba mesh_colour(const Mesh& mesh, std::size_t face, int x, int y) const;
  static Texel texel_at(const Section& section, double x, double y);
  Rgba section_colour(const Section& section, int x, int y) const;

  SampleGrid grid_;
  Matrix4 view_projection_;
  PrimitiveId next_ = 0;
  std::vector<Mesh> meshes_;
  std::vector<Section> sections_;
  std::vector<Ribbon> ribbons_;
  PrimitiveId first_line_ = 0;
  std::vector<Rgba> line_colours_;
};

}  // namespace footwall::render
