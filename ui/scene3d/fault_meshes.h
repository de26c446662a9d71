// The faults' faces on the graphics card: buffers of each fault for itself, so that an edit uploads that
// fault alone.
#pragma once
#include <map>
#include <memory>

#include "ui/model/voxel_bricks.h"
#include "ui/scene3d/fault_geometry.h"
#include "ui/scene3d/gl.h"
#include "ui/scene3d/pass.h"

namespace footwall::ui {

// How the faces of a fault are coloured.
struct FaceColouring {
  bool plain = true;
  bool hatched = false;  // all of them: the colours are old
  std::array<float, 3> plain_colour{0.5F, 0.5F, 0.5F};
  std::array<float, 3> undefined_colour{0.42F, 0.44F, 0.47F};
  std::array<float, 2> range{0, 1};
  GLuint colours = 0;  // texture, 256 x 1
  bool edges = false;
  // By the samples that they cut, where put_voxels() has brought them; else plain.
  bool voxels = false;
  render::Matrix4 to_voxels{};      // the scene, exaggerated, to the survey's index space
  std::optional<bool> interpolate;  // as SampleLook
};

class FaultMeshes {
 public:
  void build(Gl& gl);
  void release(Gl& gl);

  void put(Gl& gl, std::shared_ptr<const FaultGeometry> geometry);
  // values and states of the faces, in their order; states: 1 stale, 2 hatched. Fewer than faces: the rest is
  // undefined.
  void put_numbers(Gl& gl, Id fault, std::span<const double> values, std::span<const std::uint8_t> stale,
                   std::span<const std::uint8_t> hatched);
  // The samples around the fault; null: none. Kept through put().
  void put_voxels(Gl& gl, Id fault, std::shared_ptr<const VoxelBricks> bricks);
  void remove(Gl& gl, Id fault);
  bool has(Id fault) const { return meshes_.contains(fault); }
  const FaultGeometry* geometry(Id fault) const;
  std::size_t face_count(Id fault) const;

  // The camera of the draws that follow.
  void look_through(Gl& gl, const Pass& pass);
  // Faces [first, first + count); returns the number drawn.
  std::size_t draw(Gl& gl, Id fault, const FaceColouring& how, std::size_t first, std::size_t count);
  // Of a level: at most so many faces. The buffers are made at the first call.
  static constexpr std::array<std::size_t, 3> kCoarse{1500, 300, 90};
  std::size_t coarse_count(Id fault, int level) const;
  // So that the first move of the camera need not make it.
  // False where there was nothing to do.
  bool make_coarse(Gl& gl, Id fault, int level);
  std::size_t draw_coarse(Gl& gl, Id fault, const FaceColouring& how, int level);

 private:
  struct Coarse {
    GlBuffer corners, faces;
    std::size_t count = 0;
    bool made = false;
  };
  struct Mesh {
    std::shared_ptr<const FaultGeometry> geometry;
    GlBuffer positions, corners, faces;
    std::shared_ptr<const VoxelBricks> bricks;
    GlBuffer table, samples;
    std::array<Coarse, kCoarse.size()> coarse;
  };
  void make(Gl& gl, Mesh& mesh, std::size_t level);
  GlProgram& prepare(Gl& gl, const Mesh& mesh, const FaceColouring& how, bool edges);
  void prepare_voxels(Gl& gl, GlProgram& program, const Mesh& mesh, const FaceColouring& how);
  void drop(Gl& gl, Mesh& mesh);

  GlProgram smooth_, edged_, voxels_, edged_voxels_;
  GLuint layout_ = 0;
  std::map<Id, Mesh> meshes_;
};

}  // namespace footwall::ui
