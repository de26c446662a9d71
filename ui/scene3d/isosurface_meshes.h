// Isosurfaces as triangles on the graphics card.
#pragma once
#include <map>
#include <memory>

#include "ui/scene3d/gl.h"
#include "ui/scene3d/isosurface_maker.h"
#include "ui/scene3d/pass.h"

namespace footwall::ui {

class IsosurfaceMeshes {
 public:
  void build(Gl& gl);
  void release(Gl& gl);

  void put(Gl& gl, std::shared_ptr<const IsosurfaceShape> shape);
  void remove(Gl& gl, Id isosurface);
  std::vector<Id> all() const;
  // Null where there is none.
  const IsosurfaceShape* shape(Id isosurface) const;
  std::size_t triangle_count(Id isosurface) const;
  std::size_t coarse_count(Id isosurface, std::size_t level) const;

  // Triangles [first, first + count); returns the number drawn.
  std::size_t draw(Gl& gl, const Pass& pass, Id isosurface, const std::array<float, 3>& colour,
                   std::size_t first, std::size_t count);
  std::size_t draw_coarse(Gl& gl, const Pass& pass, Id isosurface, const std::array<float, 3>& colour,
                          std::size_t level);

 private:
  struct Mesh {
    std::shared_ptr<const IsosurfaceShape> shape;
    GlBuffer positions, normals, corners;
    std::array<GlBuffer, IsosurfaceShape::kCoarse.size()> coarse;
  };
  void drop(Gl& gl, Mesh& mesh);
  std::size_t draw_corners(Gl& gl, const Pass& pass, const Mesh& mesh, const std::array<float, 3>& colour,
                           const GlBuffer& corners, std::size_t first, std::size_t count);

  GlProgram program_;
  GLuint layout_ = 0;
  std::map<Id, Mesh> meshes_;
};

}  // namespace footwall::ui
