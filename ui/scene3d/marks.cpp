#include "ui/scene3d/marks.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

constexpr int kAtlasWidth = 2048;

struct SpriteInstance {
  std::array<float, 3> anchor;
  std::array<float, 4> box;
  std::array<float, 4> part;
  float flat;
};

struct Attribute {
  int floats;
  std::size_t offset;
};

// Instances of floats alone.
GLuint instances(Gl& gl, std::span<const Attribute> attributes) {
  GLuint layout = 0;
  gl.glCreateVertexArrays(1, &layout);
  for (std::size_t n = 0; n < attributes.size(); ++n) {
    const auto place = static_cast<GLuint>(n);
    gl.glEnableVertexArrayAttrib(layout, place);
    gl.glVertexArrayAttribFormat(layout, place, attributes[n].floats, GL_FLOAT, GL_FALSE,
                                 static_cast<GLuint>(attributes[n].offset));
    gl.glVertexArrayAttribBinding(layout, place, 0);
  }
  gl.glVertexArrayBindingDivisor(layout, 0, 1);
  return layout;
}

void set_common(Gl& gl, GlProgram& program, const Pass& pass, float lift) {
  program.set(gl, "view_projection", pass.camera.view_projection);
  program.set(gl, "size", std::array{static_cast<float>(pass.width), static_cast<float>(pass.height)});
  program.set(gl, "pixel", static_cast<float>(pass.pixel));
  program.set(gl, "lift", lift);
  program.use(gl);
}

void draw_instances(Gl& gl, GLuint layout, const GlBuffer& buffer, std::size_t size, std::size_t count) {
  gl.glEnable(GL_BLEND);
  gl.glDepthMask(GL_FALSE);
  gl.glBindVertexArray(layout);
  gl.glVertexArrayVertexBuffer(layout, 0, buffer.name(), 0, static_cast<GLsizei>(size));
  gl.glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
  gl.glDepthMask(GL_TRUE);
  gl.glDisable(GL_BLEND);
}

}  // namespace

Rgba4 rgba_of(const QColor& colour) {
  return {colour.redF(), colour.greenF(), colour.blueF(), colour.alphaF()};
}

void SpriteBatch::set(Gl& gl, const std::vector<Sprite>& sprites) {
  count_ = sprites.size();
  if (sprites.empty()) return;
  // Rows of images, one below the other.
  std::vector<SpriteInstance> placed;
  int x = 0, y = 0, row = 0, width = 1;
  for (const Sprite& sprite : sprites) {
    const QSize size = sprite.image.size();
    if (x > 0 && x + size.width() > kAtlasWidth) {
      y += row;
      x = row = 0;
    }
    const double ratio = sprite.image.devicePixelRatio();
    placed.push_back({{sprite.anchor.x, sprite.anchor.y, sprite.anchor.z},
                      {static_cast<float>(sprite.off.x()), static_cast<float>(sprite.off.y()),
                       static_cast<float>(size.width() / ratio), static_cast<float>(size.height() / ratio)},
                      {static_cast<float>(x), static_cast<float>(y), static_cast<float>(size.width()),
                       static_cast<float>(size.height())},
                      sprite.flat ? 1.0F : 0.0F});
    x += size.width();
    width = std::max(width, x);
    row = std::max(row, size.height());
  }
  QImage atlas(width, std::max(1, y + row), QImage::Format_RGBA8888_Premultiplied);
  atlas.fill(0);
  QPainter painter(&atlas);
  painter.setCompositionMode(QPainter::CompositionMode_Source);
  for (std::size_t n = 0; n < sprites.size(); ++n) {
    QImage image = sprites[n].image;
    image.setDevicePixelRatio(1);
    painter.drawImage(QPointF(placed[n].part[0], placed[n].part[1]), image);
  }
  painter.end();
  if (atlas_ != 0) gl.glDeleteTextures(1, &atlas_);
  gl.glCreateTextures(GL_TEXTURE_2D, 1, &atlas_);
  gl.glTextureStorage2D(atlas_, 1, GL_RGBA8, atlas.width(), atlas.height());
  gl.glTextureSubImage2D(atlas_, 0, 0, 0, atlas.width(), atlas.height(), GL_RGBA, GL_UNSIGNED_BYTE,
                         atlas.constBits());
  gl.glTextureParameteri(atlas_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  buffer_.set(gl, placed);
}

void SpriteBatch::release(Gl& gl) {
  buffer_.release(gl);
  if (atlas_ != 0) gl.glDeleteTextures(1, &atlas_);
  *this = {};
}

void Marks::build(Gl& gl) {
  lines_.build(gl, "line.vert", "line.frag");
  dots_.build(gl, "dot.vert", "dot.frag");
  sprites_.build(gl, "sprite.vert", "sprite.frag");
  line_layout_ = instances(gl, std::array<Attribute, 4>{{{3, offsetof(Line, from)},
                                                         {3, offsetof(Line, to)},
                                                         {4, offsetof(Line, colour)},
                                                         {1, offsetof(Line, width)}}});
  dot_layout_ = instances(gl, std::array<Attribute, 4>{{{3, offsetof(Dot, at)},
                                                        {4, offsetof(Dot, fill)},
                                                        {4, offsetof(Dot, rim)},
                                                        {1, offsetof(Dot, diameter)}}});
  sprite_layout_ = instances(gl, std::array<Attribute, 4>{{{3, offsetof(SpriteInstance, anchor)},
                                                           {4, offsetof(SpriteInstance, box)},
                                                           {4, offsetof(SpriteInstance, part)},
                                                           {1, offsetof(SpriteInstance, flat)}}});
}

void Marks::release(Gl& gl) {
  for (GlProgram* program : {&lines_, &dots_, &sprites_}) program->release(gl);
  for (GLuint* layout : {&line_layout_, &dot_layout_, &sprite_layout_}) {
    if (*layout != 0) gl.glDeleteVertexArrays(1, layout);
    *layout = 0;
  }
}

void Marks::draw(Gl& gl, const Pass& pass, const MarkBatch<Line>& lines, bool heights, float lift) {
  if (lines.count == 0) return;
  set_common(gl, lines_, pass, lift);
  lines_.set(gl, "heights", heights ? static_cast<float>(pass.heights) : 1.0F);
  gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_instances(gl, line_layout_, lines.buffer, sizeof(Line), lines.count);
}

void Marks::draw(Gl& gl, const Pass& pass, const MarkBatch<Dot>& dots, bool heights) {
  if (dots.count == 0) return;
  set_common(gl, dots_, pass, 1.5F * kLift);
  dots_.set(gl, "heights", heights ? static_cast<float>(pass.heights) : 1.0F);
  gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_instances(gl, dot_layout_, dots.buffer, sizeof(Dot), dots.count);
}

void Marks::draw(Gl& gl, const Pass& pass, const SpriteBatch& sprites) {
  if (sprites.count() == 0) return;
  set_common(gl, sprites_, pass, kLift);
  sprites_.set(gl, "corner", std::array{static_cast<float>(pass.left), static_cast<float>(pass.top)});
  sprites_.set(gl, "atlas", 0);
  gl.glBindTextureUnit(0, sprites.atlas());
  gl.glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_instances(gl, sprite_layout_, sprites.buffer(), sizeof(SpriteInstance), sprites.count());
}

Sprite selecting_sprite(const QPolygonF& region, const QColor& accent, double pixel) {
  const QRect box = region.boundingRect().toAlignedRect().adjusted(-2, -2, 2, 2);
  QImage image(box.size() * pixel, QImage::Format_RGBA8888_Premultiplied);
  image.setDevicePixelRatio(pixel);
  image.fill(0);
  QColor ground = accent;
  ground.setAlphaF(0.12F);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(-box.topLeft());
  painter.setPen(QPen(accent, 1, Qt::DashLine));
  painter.setBrush(ground);
  painter.drawPolygon(region);
  painter.end();
  return {image, {static_cast<float>(box.left()), static_cast<float>(box.top()), 0}, {}, true};
}

QImage text_image(const QString& text, const QFont& font, const QColor& colour, const QColor& halo,
                  double pixel) {
  const QFontMetricsF metrics(font);
  constexpr double kMargin = 2;
  const double width = std::ceil(metrics.horizontalAdvance(text)) + 2 * kMargin;
  const double height = std::ceil(metrics.height()) + 2 * kMargin;
  QImage image(QSize(static_cast<int>(std::ceil(width * pixel)), static_cast<int>(std::ceil(height * pixel))),
               QImage::Format_RGBA8888_Premultiplied);
  image.setDevicePixelRatio(pixel);
  image.fill(0);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath path;
  path.addText(kMargin, kMargin + metrics.ascent(), font, text);
  QColor soft = halo;
  soft.setAlpha(170);
  painter.strokePath(path, QPen(soft, 3, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setFont(font);
  painter.setPen(colour);
  painter.drawText(QPointF(kMargin, kMargin + metrics.ascent()), text);
  return image;
}

}  // namespace footwall::ui
