// A picture of isosurfaces from the engine, put into the scene's depths: exact from where it was made, a
// cloud of its pixels while the camera is on its way.
#pragma once
#include "ui/model/engine_link.h"
#include "ui/scene3d/gl.h"
#include "ui/scene3d/pass.h"

namespace footwall::ui {

class IsosurfacePicture {
 public:
  void build(Gl& gl);
  void release(Gl& gl);
  // view_projection: the picture's own.
  void put(Gl& gl, const Picture& picture, const render::Matrix4& view_projection);
  void clear() { shown_ = false; }
  bool is_shown() const { return shown_; }
  // True where it was made for this camera.
  bool fits(const render::Matrix4& view_projection) const { return view_projection == view_projection_; }
  void draw(Gl& gl, const Pass& pass);

 private:
  GlProgram exact_, points_;
  GLuint layout_ = 0, colours_ = 0, depths_ = 0;
  int width_ = 0, height_ = 0;
  render::Matrix4 view_projection_{};
  bool shown_ = false;
};

// All zero for a matrix without one.
render::Matrix4 inverse_of(const render::Matrix4& m);
render::Matrix4 product_of(const render::Matrix4& a, const render::Matrix4& b);

}  // namespace footwall::ui
