#include "ui/scene3d/section_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace footwall::ui {

using render::Vec3;

PlanePlace place_of(const Section& section, const render::SceneFrame& frame) {
  const PlaneSize size = size_of(section, frame.geometry());
  // A line's last column may lie short of its end, so u is measured in voxels there, too.
  const auto corner = [&](double u, double v) { return frame.scene_of(index_of(section, {u, v})); };
  const Vec3 origin = corner(-0.5, -0.5);
  return {origin, corner(size.width - 0.5, -0.5) - origin, corner(-0.5, size.height - 0.5) - origin};
}

std::optional<PlaneHit> hit_of(const Ray& ray, const PlanePlace& place, const PlaneSize& size) {
  const Vec3 normal = cross(place.across, place.down);
  const double towards = dot(ray.along, normal);
  if (std::abs(towards) < 1e-9 * length(normal)) return {};
  const double distance = dot(place.origin - ray.from, normal) / towards;
  if (!(distance > 0)) return {};
  const Vec3 off = ray.from + ray.along * distance - place.origin;
  // across and down need not be at right angles.
  const double aa = dot(place.across, place.across);
  const double ad = dot(place.across, place.down);
  const double dd = dot(place.down, place.down);
  const double det = aa * dd - ad * ad;
  const double s = (dot(off, place.across) * dd - dot(off, place.down) * ad) / det;
  const double t = (dot(off, place.down) * aa - dot(off, place.across) * ad) / det;
  if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return {};
  return PlaneHit{distance, {s * size.width - 0.5, t * size.height - 0.5}};
}

void SectionPlanes::build(Gl& gl) {
  program_.build(gl, "plane.vert", "plane.frag");
  gl.glCreateVertexArrays(1, &layout_);
}

void SectionPlanes::release(Gl& gl) {
  for (auto& [plane, texture] : textures_) gl.glDeleteTextures(1, &texture.name);
  textures_.clear();
  program_.release(gl);
  if (layout_ != 0) gl.glDeleteVertexArrays(1, &layout_);
  layout_ = 0;
}

void SectionPlanes::put(Gl& gl, Id plane, std::shared_ptr<const SectionSamples> samples) {
  Texture& texture = textures_[plane];
  const bool same_size = texture.samples && texture.samples->columns == samples->columns &&
                         texture.samples->rows == samples->rows && texture.name != 0;
  texture.samples = std::move(samples);
  const int columns = texture.samples->columns;
  const int rows = texture.samples->rows;
  if (columns < 1 || rows < 1) return;
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::vector<std::array<float, 2>> texels(count, {0.0F, 0.0F});
  for (std::size_t n = 0; n < std::min(count, texture.samples->values.size()); ++n) {
    const float value = texture.samples->values[n];
    if (std::isfinite(value)) texels[n] = {value, 1.0F};
  }
  const int levels = std::bit_width(static_cast<unsigned>(std::max(columns, rows)));
  if (!same_size) {
    if (texture.name != 0) gl.glDeleteTextures(1, &texture.name);
    gl.glCreateTextures(GL_TEXTURE_2D, 1, &texture.name);
    gl.glTextureStorage2D(texture.name, levels, GL_RG32F, columns, rows);
    gl.glTextureParameteri(texture.name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.glTextureParameteri(texture.name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.glTextureParameteri(texture.name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.glTextureParameteri(texture.name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  gl.glTextureSubImage2D(texture.name, 0, 0, 0, columns, rows, GL_RG, GL_FLOAT, texels.data());
  gl.glGenerateTextureMipmap(texture.name);
}

void SectionPlanes::remove(Gl& gl, Id plane) {
  const auto found = textures_.find(plane);
  if (found == textures_.end()) return;
  if (found->second.name != 0) gl.glDeleteTextures(1, &found->second.name);
  textures_.erase(found);
}

const SectionSamples* SectionPlanes::samples(Id plane) const {
  const auto found = textures_.find(plane);
  return found == textures_.end() ? nullptr : found->second.samples.get();
}

void SectionPlanes::draw(Gl& gl, const Pass& pass, Id plane, const PlanePlace& place, const PlaneLook& look) {
  const auto found = textures_.find(plane);
  if (found == textures_.end() || found->second.name == 0) return;
  program_.set(gl, "view_projection", pass.camera.view_projection);
  program_.set(gl, "origin", place.origin);
  program_.set(gl, "across", place.across);
  program_.set(gl, "down", place.down);
  program_.set(gl, "samples", 0);
  program_.set(gl, "colours", 1);
  program_.set(gl, "range", look.range);
  program_.set(gl, "quick", pass.quick ? 1 : 0);
  program_.set(gl, "smoothed", look.interpolate ? static_cast<int>(*look.interpolate) : -1);
  program_.set(gl, "pixel", static_cast<float>(pass.pixel));
  program_.use(gl);
  gl.glBindTextureUnit(0, found->second.name);
  gl.glBindTextureUnit(1, look.colours);
  gl.glBindVertexArray(layout_);
  gl.glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace footwall::ui
