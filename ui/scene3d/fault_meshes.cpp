#include "ui/scene3d/fault_meshes.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace footwall::ui {

void FaultMeshes::build(Gl& gl) {
  smooth_.build(gl, "faces.vert", "faces.frag", "#version 450 core\n");
  edged_.build(gl, "faces_edges.vert", "faces.frag", "#version 450 core\n#define EDGES\n");
  voxels_.build(gl, "faces.vert", "faces.frag", "#version 450 core\n#define VOXELS\n");
  edged_voxels_.build(gl, "faces_edges.vert", "faces.frag",
                      "#version 450 core\n#define VOXELS\n#define EDGES\n");
  gl.glCreateVertexArrays(1, &layout_);
  gl.glEnableVertexArrayAttrib(layout_, 0);
  gl.glVertexArrayAttribFormat(layout_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  gl.glVertexArrayAttribBinding(layout_, 0, 0);
}

void FaultMeshes::release(Gl& gl) {
  for (auto& [fault, mesh] : meshes_) drop(gl, mesh);
  meshes_.clear();
  for (GlProgram* program : {&smooth_, &edged_, &voxels_, &edged_voxels_}) program->release(gl);
  if (layout_ != 0) gl.glDeleteVertexArrays(1, &layout_);
  layout_ = 0;
}

void FaultMeshes::drop(Gl& gl, Mesh& mesh) {
  for (GlBuffer* buffer : {&mesh.positions, &mesh.corners, &mesh.faces, &mesh.table, &mesh.samples})
    buffer->release(gl);
  for (Coarse& coarse : mesh.coarse) {
    coarse.corners.release(gl);
    coarse.faces.release(gl);
    coarse = {};
  }
}

void FaultMeshes::put(Gl& gl, std::shared_ptr<const FaultGeometry> geometry) {
  Mesh& mesh = meshes_[geometry->surface().fault];
  mesh.geometry = std::move(geometry);
  mesh.positions.set(gl, mesh.geometry->positions());
  mesh.corners.set(gl, mesh.geometry->corners());
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  mesh.faces.set(gl, std::vector<std::array<float, 2>>(mesh.geometry->face_count(), {unknown, 0.0F}));
  for (Coarse& coarse : mesh.coarse) coarse.made = false;
}

void FaultMeshes::put_numbers(Gl& gl, Id fault, std::span<const double> values,
                              std::span<const std::uint8_t> stale, std::span<const std::uint8_t> hatched) {
  const auto found = meshes_.find(fault);
  if (found == meshes_.end()) return;
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  std::vector<std::array<float, 2>> faces(found->second.geometry->face_count(), {unknown, 0.0F});
  for (std::size_t n = 0; n < std::min(faces.size(), values.size()); ++n) {
    const int state =
        (n < stale.size() && stale[n] != 0 ? 1 : 0) + (n < hatched.size() && hatched[n] != 0 ? 2 : 0);
    faces[n] = {static_cast<float>(values[n]), static_cast<float>(state)};
  }
  found->second.faces.set(gl, faces);
}

void FaultMeshes::put_voxels(Gl& gl, Id fault, std::shared_ptr<const VoxelBricks> bricks) {
  const auto found = meshes_.find(fault);
  if (found == meshes_.end()) return;
  Mesh& mesh = found->second;
  if (mesh.bricks == bricks) return;
  mesh.bricks = std::move(bricks);
  if (mesh.bricks == nullptr) {
    mesh.table.release(gl);
    mesh.samples.release(gl);
    return;
  }
  mesh.table.set(gl, mesh.bricks->table);
  mesh.samples.set(gl, mesh.bricks->samples);
}

void FaultMeshes::remove(Gl& gl, Id fault) {
  const auto found = meshes_.find(fault);
  if (found == meshes_.end()) return;
  drop(gl, found->second);
  meshes_.erase(found);
}

const FaultGeometry* FaultMeshes::geometry(Id fault) const {
  const auto found = meshes_.find(fault);
  return found == meshes_.end() ? nullptr : found->second.geometry.get();
}

std::size_t FaultMeshes::face_count(Id fault) const {
  const FaultGeometry* geometry_of = geometry(fault);
  return geometry_of == nullptr ? 0 : geometry_of->face_count();
}

void FaultMeshes::look_through(Gl& gl, const Pass& pass) {
  const render::Camera& camera = pass.camera;
  for (GlProgram* program : {&smooth_, &edged_, &voxels_, &edged_voxels_}) {
    program->set(gl, "quick", pass.quick ? 1 : 0);
    program->set(gl, "view_projection", camera.view_projection);
    program->set(gl, "heights", static_cast<float>(pass.heights));
    program->set(gl, "colours", 0);
    program->set(gl, "eye", camera.eye);
    program->set(gl, "forward", camera.forward);
    program->set(gl, "lamp", camera.right * -0.66 + camera.up * 0.55 + camera.forward * -0.51);
    program->set(gl, "perspective", camera.perspective ? 1 : 0);
    program->set(gl, "pixel", static_cast<float>(pass.pixel));
  }
}

GlProgram& FaultMeshes::prepare(Gl& gl, const Mesh& mesh, const FaceColouring& how, bool edges) {
  const bool voxels = how.voxels && mesh.bricks != nullptr && mesh.bricks->count() > 0;
  GlProgram& program = voxels ? (edges ? edged_voxels_ : voxels_) : edges ? edged_ : smooth_;
  if (voxels) prepare_voxels(gl, program, mesh, how);
  program.set(gl, "plain", how.plain || how.voxels ? 1 : 0);
  program.set(gl, "all_hatched", how.hatched ? 1 : 0);
  if (how.plain || how.voxels) program.set(gl, "plain_colour", how.plain_colour);
  program.set(gl, "undefined_colour", how.undefined_colour);
  program.set(gl, "range", how.range);
  program.use(gl);
  gl.glBindTextureUnit(0, how.colours);
  gl.glBindVertexArray(layout_);
  gl.glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, mesh.faces.name());
  return program;
}

void FaultMeshes::prepare_voxels(Gl& gl, GlProgram& program, const Mesh& mesh, const FaceColouring& how) {
  const VoxelBricks& bricks = *mesh.bricks;
  const auto step = static_cast<double>(bricks.step);
  render::Matrix4 to_samples = how.to_voxels;
  std::array<float, 3> size{}, lowest{}, highest{}, counts{};
  for (std::size_t n = 0; n < 3; ++n) {
    to_samples[4 * n + 3] -= static_cast<double>(bricks.origin[n]);
    for (std::size_t column = 0; column < 4; ++column) to_samples[4 * n + column] /= step;
    size[n] = static_cast<float>(bricks.sampled()[n]);
    lowest[n] = static_cast<float>(-0.5 / step);
    highest[n] = static_cast<float>((static_cast<double>(bricks.size[n]) - 0.5) / step);
    counts[n] = static_cast<float>(bricks.bricks()[n]);
  }
  program.set(gl, "to_samples", to_samples);
  program.set(gl, "size", size);
  program.set(gl, "lowest", lowest);
  program.set(gl, "highest", highest);
  program.set(gl, "bricks", counts);
  program.set(gl, "table_bits", std::countr_zero(bricks.table.size()));
  program.set(gl, "longest", bricks.longest);
  program.set(gl, "smoothed", how.interpolate ? static_cast<int>(*how.interpolate) : -1);
  gl.glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, mesh.table.name());
  gl.glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, mesh.samples.name());
}

std::size_t FaultMeshes::draw(Gl& gl, Id fault, const FaceColouring& how, std::size_t first,
                              std::size_t count) {
  const auto found = meshes_.find(fault);
  if (found == meshes_.end()) return 0;
  const Mesh& mesh = found->second;
  count = std::min(count, mesh.geometry->face_count() - std::min(first, mesh.geometry->face_count()));
  if (count == 0) return 0;
  GlProgram& program = prepare(gl, mesh, how, how.edges);
  program.set(gl, "first_face", static_cast<int>(first));
  program.set(gl, "coarse", 0);
  if (how.edges) {
    gl.glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, mesh.positions.name());
    gl.glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, mesh.corners.name());
    gl.glDrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * first), static_cast<GLsizei>(3 * count));
    return count;
  }
  gl.glVertexArrayVertexBuffer(layout_, 0, mesh.positions.name(), 0, sizeof(render::Vec3f));
  gl.glVertexArrayElementBuffer(layout_, mesh.corners.name());
  gl.glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(3 * first * sizeof(std::uint32_t)));
  return count;
}

void FaultMeshes::make(Gl& gl, Mesh& mesh, std::size_t level) {
  const CoarseFaces few = mesh.geometry->coarse(kCoarse[level]);
  Coarse& coarse = mesh.coarse[level];
  coarse.corners.set(gl, few.corners);
  coarse.faces.set(gl, few.faces);
  coarse.count = few.faces.size();
  coarse.made = true;
}

bool FaultMeshes::make_coarse(Gl& gl, Id fault, int level) {
  const auto found = meshes_.find(fault);
  const auto at = static_cast<std::size_t>(level);
  if (found == meshes_.end() || found->second.coarse.at(at).made) return false;
  if (found->second.geometry->face_count() <= kCoarse.at(at)) return false;
  make(gl, found->second, at);
  return true;
}

std::size_t FaultMeshes::coarse_count(Id fault, int level) const {
  return std::min(face_count(fault), kCoarse.at(static_cast<std::size_t>(level)));
}

std::size_t FaultMeshes::draw_coarse(Gl& gl, Id fault, const FaceColouring& how, int level) {
  const auto found = meshes_.find(fault);
  if (found == meshes_.end()) return 0;
  Mesh& mesh = found->second;
  const std::size_t most = kCoarse.at(static_cast<std::size_t>(level));
  if (mesh.geometry->face_count() <= most) return draw(gl, fault, how, 0, mesh.geometry->face_count());
  Coarse& coarse = mesh.coarse.at(static_cast<std::size_t>(level));
  if (!coarse.made) make(gl, mesh, static_cast<std::size_t>(level));
  if (coarse.count == 0) return 0;
  GlProgram& program = prepare(gl, mesh, how, false);
  program.set(gl, "first_face", 0);
  program.set(gl, "coarse", 1);
  gl.glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, coarse.faces.name());
  gl.glVertexArrayVertexBuffer(layout_, 0, mesh.positions.name(), 0, sizeof(render::Vec3f));
  gl.glVertexArrayElementBuffer(layout_, coarse.corners.name());
  gl.glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * coarse.count), GL_UNSIGNED_INT, nullptr);
  return coarse.count;
}

}  // namespace footwall::ui
