// Lines, dots and small images of constant size in the picture, each kind drawn in one call.
#pragma once
#include <QColor>
#include <QHash>
#include <QImage>
#include <QPolygonF>
#include <vector>

#include "ui/scene3d/gl.h"
#include "ui/scene3d/pass.h"

namespace footwall::ui {

using Rgba4 = std::array<float, 4>;
Rgba4 rgba_of(const QColor& colour);

struct Line {
  render::Vec3f from, to;
  Rgba4 colour{};
  float width = 1;  // pixels
};

struct Dot {
  render::Vec3f at;
  Rgba4 fill{}, rim{};
  float diameter = 8;  // pixels
};

// An image whose upper left corner lies `off` pixels from the anchor: a place in the scene (hidden by what is
// in front of it), or pixels from the picture's upper left corner.
struct Sprite {
  QImage image;  // with its devicePixelRatio
  render::Vec3f anchor;
  QPointF off;
  bool flat = false;
};

// The box or lasso that is being drawn, in pixels from the upper left corner.
Sprite selecting_sprite(const QPolygonF& region, const QColor& accent, double pixel);

// Marks as they were last set.
template <class Mark>
struct MarkBatch {
  GlBuffer buffer;
  std::size_t count = 0;
  void set(Gl& gl, const std::vector<Mark>& marks) {
    buffer.set(gl, marks);
    count = marks.size();
  }
  void release(Gl& gl) {
    buffer.release(gl);
    count = 0;
  }
};

class SpriteBatch {
 public:
  void set(Gl& gl, const std::vector<Sprite>& sprites);
  void release(Gl& gl);
  GLuint atlas() const { return atlas_; }
  const GlBuffer& buffer() const { return buffer_; }
  std::size_t count() const { return count_; }

 private:
  GlBuffer buffer_;
  GLuint atlas_ = 0;
  std::size_t count_ = 0;
};

class Marks {
 public:
  void build(Gl& gl);
  void release(Gl& gl);
  // heights: the marks are at exaggeration 1. Depth is tested, not written.
  void draw(Gl& gl, const Pass& pass, const MarkBatch<Line>& lines, bool heights, float lift = kLift);
  void draw(Gl& gl, const Pass& pass, const MarkBatch<Dot>& dots, bool heights);
  void draw(Gl& gl, const Pass& pass, const SpriteBatch& sprites);
  // Share of what lies between a mark and the far end by which it comes nearer, so that it shows on its
  // surface.
  static constexpr float kLift = 0.004F;

 private:
  GlProgram lines_, dots_, sprites_;
  GLuint line_layout_ = 0, dot_layout_ = 0, sprite_layout_ = 0;
};

// Text as an image, with a soft halo of the background's colour.
QImage text_image(const QString& text, const QFont& font, const QColor& colour, const QColor& halo,
                  double pixel);

}  // namespace footwall::ui
