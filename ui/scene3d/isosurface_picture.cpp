#include "ui/scene3d/isosurface_picture.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

constexpr int kPixelsBetweenPoints = 3;

}  // namespace

render::Matrix4 product_of(const render::Matrix4& a, const render::Matrix4& b) {
  render::Matrix4 c{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t n = 0; n < 4; ++n) c[4 * row + column] += a[4 * row + n] * b[4 * n + column];
    }
  }
  return c;
}

render::Matrix4 inverse_of(const render::Matrix4& m) {
  // Gauss and Jordan, with the largest pivot.
  render::Matrix4 left = m;
  render::Matrix4 right{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  for (std::size_t at = 0; at < 4; ++at) {
    std::size_t pivot = at;
    for (std::size_t row = at + 1; row < 4; ++row) {
      if (std::abs(left[4 * row + at]) > std::abs(left[4 * pivot + at])) pivot = row;
    }
    const double size = left[4 * pivot + at];
    if (size == 0 || !std::isfinite(size)) return {};
    for (std::size_t n = 0; n < 4; ++n) {
      std::swap(left[4 * at + n], left[4 * pivot + n]);
      std::swap(right[4 * at + n], right[4 * pivot + n]);
    }
    for (std::size_t n = 0; n < 4; ++n) {
      left[4 * at + n] /= size;
      right[4 * at + n] /= size;
    }
    for (std::size_t row = 0; row < 4; ++row) {
      const double share = left[4 * row + at];
      if (row == at || share == 0) continue;
      for (std::size_t n = 0; n < 4; ++n) {
        left[4 * row + n] -= share * left[4 * at + n];
        right[4 * row + n] -= share * right[4 * at + n];
      }
    }
  }
  return right;
}

void IsosurfacePicture::build(Gl& gl) {
  exact_.build(gl, "screen.vert", "picture.frag", "");
  points_.build(gl, "picture_points.vert", "picture_points.frag", "");
  gl.glCreateVertexArrays(1, &layout_);
}

void IsosurfacePicture::release(Gl& gl) {
  exact_.release(gl);
  points_.release(gl);
  if (layout_ != 0) gl.glDeleteVertexArrays(1, &layout_);
  if (colours_ != 0) gl.glDeleteTextures(1, &colours_);
  if (depths_ != 0) gl.glDeleteTextures(1, &depths_);
  *this = {};
}

void IsosurfacePicture::put(Gl& gl, const Picture& picture, const render::Matrix4& view_projection) {
  const QImage image = picture.colours.convertToFormat(QImage::Format_RGBA8888);
  const auto pixels = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  shown_ = false;
  if (pixels == 0 || picture.depths.size() != pixels) return;
  if (image.width() != width_ || image.height() != height_) {
    if (colours_ != 0) gl.glDeleteTextures(1, &colours_);
    if (depths_ != 0) gl.glDeleteTextures(1, &depths_);
    width_ = image.width();
    height_ = image.height();
    gl.glCreateTextures(GL_TEXTURE_2D, 1, &colours_);
    gl.glCreateTextures(GL_TEXTURE_2D, 1, &depths_);
    gl.glTextureStorage2D(colours_, 1, GL_RGBA8, width_, height_);
    gl.glTextureStorage2D(depths_, 1, GL_R32F, width_, height_);
    for (const GLuint texture : {colours_, depths_}) {
      gl.glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      gl.glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
      gl.glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
      gl.glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
  }
  gl.glTextureSubImage2D(colours_, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.constBits());
  gl.glTextureSubImage2D(depths_, 0, 0, 0, width_, height_, GL_RED, GL_FLOAT, picture.depths.data());
  view_projection_ = view_projection;
  shown_ = true;
}

void IsosurfacePicture::draw(Gl& gl, const Pass& pass) {
  if (!shown_) return;
  gl.glBindTextureUnit(0, colours_);
  gl.glBindTextureUnit(1, depths_);
  gl.glBindVertexArray(layout_);
  if (fits(pass.whole)) {
    exact_.set(gl, "colours", 0);
    exact_.set(gl, "depths", 1);
    const auto share = [](int part, int of) { return static_cast<float>(part) / static_cast<float>(of); };
    exact_.set(gl, "part",
               std::array{share(pass.left, pass.whole_width),
                          share(pass.whole_height - pass.top - pass.height, pass.whole_height),
                          share(pass.width, pass.whole_width), share(pass.height, pass.whole_height)});
    exact_.use(gl);
    gl.glDrawArrays(GL_TRIANGLES, 0, 3);
    return;
  }
  points_.set(gl, "colours", 0);
  points_.set(gl, "depths", 1);
  points_.set(gl, "from_picture", product_of(pass.camera.view_projection, inverse_of(view_projection_)));
  points_.set(gl, "step", kPixelsBetweenPoints);
  points_.set(gl, "point",
              static_cast<float>(kPixelsBetweenPoints + 1) * static_cast<float>(pass.whole_width) /
                  static_cast<float>(width_));
  points_.use(gl);
  gl.glEnable(GL_PROGRAM_POINT_SIZE);
  gl.glDrawArrays(GL_POINTS, 0, (width_ / kPixelsBetweenPoints) * (height_ / kPixelsBetweenPoints));
}

}  // namespace footwall::ui
