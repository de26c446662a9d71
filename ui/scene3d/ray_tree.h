// Which face of a mesh a ray meets first. Boxes around 16 neighbours in the faces' order, boxes around 16 of
// those, and so on: made in linear time, and good because faces stand by panel.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/render/vector.h"
#include "ui/scene3d/orbit_camera.h"

namespace footwall::ui {

struct RayHit {
  double distance = 0;  // in lengths of the ray's `along`
  std::int32_t face = 0;
};

class RayTree {
 public:
  RayTree() = default;
  // corners: three vertices per face. Both spans must outlive the tree. Faces with a corner that is not
  // finite are never met.
  RayTree(std::span<const render::Vec3f> positions, std::span<const std::uint32_t> corners);

  // The nearest face before `farthest`, from either side.
  std::optional<RayHit> first_hit(const Ray& ray, double farthest) const;
  const render::Bounds& bounds() const { return bounds_; }

 private:
  struct Box {
    render::Vec3f lo, hi;
  };
  void visit(std::size_t level, std::size_t box, const Ray& ray, RayHit* best) const;

  std::span<const render::Vec3f> positions_;
  std::span<const std::uint32_t> corners_;
  std::vector<std::vector<Box>> levels_;  // 0: around faces
  render::Bounds bounds_;
};

// Where the ray enters the box, if before `farthest` and not behind it.
std::optional<double> entry_of(const Ray& ray, const render::Vec3f& lo, const render::Vec3f& hi,
                               double farthest);

}  // namespace footwall::ui
