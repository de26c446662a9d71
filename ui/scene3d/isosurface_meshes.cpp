#include "ui/scene3d/isosurface_meshes.h"

#include <algorithm>

namespace footwall::ui {

void IsosurfaceMeshes::build(Gl& gl) {
  program_.build(gl, "isosurface.vert", "isosurface.frag");
  gl.glCreateVertexArrays(1, &layout_);
  gl.glEnableVertexArrayAttrib(layout_, 0);
  gl.glVertexArrayAttribFormat(layout_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  gl.glVertexArrayAttribBinding(layout_, 0, 0);
  gl.glEnableVertexArrayAttrib(layout_, 1);
  gl.glVertexArrayAttribFormat(layout_, 1, 4, GL_BYTE, GL_TRUE, 0);
  gl.glVertexArrayAttribBinding(layout_, 1, 1);
}

void IsosurfaceMeshes::release(Gl& gl) {
  for (auto& [id, mesh] : meshes_) drop(gl, mesh);
  meshes_.clear();
  program_.release(gl);
  if (layout_ != 0) gl.glDeleteVertexArrays(1, &layout_);
  layout_ = 0;
}

void IsosurfaceMeshes::drop(Gl& gl, Mesh& mesh) {
  for (GlBuffer* buffer : {&mesh.positions, &mesh.normals, &mesh.corners}) buffer->release(gl);
  for (GlBuffer& buffer : mesh.coarse) buffer.release(gl);
}

void IsosurfaceMeshes::put(Gl& gl, std::shared_ptr<const IsosurfaceShape> shape) {
  Mesh& mesh = meshes_[shape->isosurface];
  mesh.shape = std::move(shape);
  mesh.positions.set(gl, mesh.shape->positions);
  mesh.normals.set(gl, mesh.shape->normals);
  mesh.corners.set(gl, mesh.shape->corners);
  for (std::size_t level = 0; level < mesh.coarse.size(); ++level)
    mesh.coarse[level].set(gl, mesh.shape->coarse[level].corners);
}

void IsosurfaceMeshes::remove(Gl& gl, Id isosurface) {
  const auto found = meshes_.find(isosurface);
  if (found == meshes_.end()) return;
  drop(gl, found->second);
  meshes_.erase(found);
}

std::vector<Id> IsosurfaceMeshes::all() const {
  std::vector<Id> ids;
  for (const auto& [id, mesh] : meshes_) ids.push_back(id);
  return ids;
}

const IsosurfaceShape* IsosurfaceMeshes::shape(Id isosurface) const {
  const auto found = meshes_.find(isosurface);
  return found == meshes_.end() ? nullptr : found->second.shape.get();
}

std::size_t IsosurfaceMeshes::triangle_count(Id isosurface) const {
  const IsosurfaceShape* of = shape(isosurface);
  return of == nullptr ? 0 : of->triangles();
}

std::size_t IsosurfaceMeshes::coarse_count(Id isosurface, std::size_t level) const {
  const IsosurfaceShape* of = shape(isosurface);
  return of == nullptr ? 0 : of->coarse.at(level).faces.size();
}

std::size_t IsosurfaceMeshes::draw(Gl& gl, const Pass& pass, Id isosurface,
                                   const std::array<float, 3>& colour, std::size_t first, std::size_t count) {
  const auto found = meshes_.find(isosurface);
  if (found == meshes_.end()) return 0;
  const std::size_t all = found->second.shape->triangles();
  first = std::min(first, all);
  return draw_corners(gl, pass, found->second, colour, found->second.corners, first,
                      std::min(count, all - first));
}

std::size_t IsosurfaceMeshes::draw_coarse(Gl& gl, const Pass& pass, Id isosurface,
                                          const std::array<float, 3>& colour, std::size_t level) {
  const auto found = meshes_.find(isosurface);
  if (found == meshes_.end()) return 0;
  return draw_corners(gl, pass, found->second, colour, found->second.coarse.at(level), 0,
                      coarse_count(isosurface, level));
}

std::size_t IsosurfaceMeshes::draw_corners(Gl& gl, const Pass& pass, const Mesh& mesh,
                                           const std::array<float, 3>& colour, const GlBuffer& corners,
                                           std::size_t first, std::size_t count) {
  if (count == 0) return 0;
  const render::Camera& camera = pass.camera;
  program_.set(gl, "view_projection", camera.view_projection);
  program_.set(gl, "heights", static_cast<float>(pass.heights));
  program_.set(gl, "eye", camera.eye);
  program_.set(gl, "forward", camera.forward);
  program_.set(gl, "lamp", camera.right * -0.66 + camera.up * 0.55 + camera.forward * -0.51);
  program_.set(gl, "perspective", camera.perspective ? 1 : 0);
  program_.set(gl, "own", colour);
  program_.use(gl);
  gl.glBindVertexArray(layout_);
  gl.glVertexArrayVertexBuffer(layout_, 0, mesh.positions.name(), 0, sizeof(render::Vec3f));
  gl.glVertexArrayVertexBuffer(layout_, 1, mesh.normals.name(), 0, sizeof(std::array<std::int8_t, 4>));
  gl.glVertexArrayElementBuffer(layout_, corners.name());
  gl.glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(3 * first * sizeof(std::uint32_t)));
  return count;
}

}  // namespace footwall::ui
