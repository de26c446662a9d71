// The section planes of the scene: where each lies, its samples as a texture, and how a ray meets it.
#pragma once
#include <map>
#include <memory>
#include <optional>

#include "engine/render/scene_frame.h"
#include "ui/model/display.h"
#include "ui/model/section_reader.h"
#include "ui/scene3d/gl.h"
#include "ui/scene3d/marks.h"
#include "ui/scene3d/orbit_camera.h"
#include "ui/scene3d/pass.h"

namespace footwall::ui {

// Scene frame, exaggeration and all.
struct PlanePlace {
  render::Vec3 origin;  // of the corner at u = v = -1/2
  render::Vec3 across;  // to the corner at u = width - 1/2
  render::Vec3 down;
};
PlanePlace place_of(const Section& section, const render::SceneFrame& frame);
// The point of the plane on the ray: its distance along it and where in the plane, in voxels; nothing beside
// the plane.
struct PlaneHit {
  double distance = 0;
  PlanePoint at;
};
std::optional<PlaneHit> hit_of(const Ray& ray, const PlanePlace& place, const PlaneSize& size);

struct PlaneLook {
  std::array<float, 2> range{0, 1};
  GLuint colours = 0;
  std::optional<bool> interpolate;
};

class SectionPlanes {
 public:
  void build(Gl& gl);
  void release(Gl& gl);
  void put(Gl& gl, Id plane, std::shared_ptr<const SectionSamples> samples);
  void remove(Gl& gl, Id plane);
  // The samples last put; null before the first.
  const SectionSamples* samples(Id plane) const;
  void draw(Gl& gl, const Pass& pass, Id plane, const PlanePlace& place, const PlaneLook& look);

 private:
  struct Texture {
    std::shared_ptr<const SectionSamples> samples;
    GLuint name = 0;
  };
  GlProgram program_;
  GLuint layout_ = 0;
  std::map<Id, Texture> textures_;
};

}  // namespace footwall::ui
