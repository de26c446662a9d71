// A fault's surface as the scene needs it: positions in the scene's frame, what a ray meets, its outline, and
// fewer faces for while the camera moves. The last three are made when first asked for.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ui/model/surfaces.h"
#include "ui/scene3d/coarse_faces.h"
#include "ui/scene3d/ray_tree.h"

namespace footwall::ui {

// World to the scene frame at exaggeration 1.
using ToScene = std::function<render::Vec3(const survey::WorldPoint&)>;

class FaultGeometry {
 public:
  FaultGeometry(std::shared_ptr<const FaultSurface> surface, const ToScene& to_scene);

  const FaultSurface& surface() const { return *surface_; }
  const std::shared_ptr<const FaultSurface>& shared_surface() const { return surface_; }
  const std::vector<render::Vec3f>& positions() const { return positions_; }
  const std::vector<std::uint32_t>& corners() const { return corners_; }
  std::size_t face_count() const { return corners_.size() / 3; }
  const render::Bounds& bounds() const { return bounds_; }  // empty (lo > hi) without a vertex

  const RayTree& tree() const;
  // Pairs of positions: edges with one face.
  const std::vector<render::Vec3f>& outline() const;
  // At most `most` faces, and not many fewer where the surface lets it; all of them where there are not more.
  CoarseFaces coarse(std::size_t most) const;

 private:
  std::shared_ptr<const FaultSurface> surface_;
  std::vector<render::Vec3f> positions_;
  std::vector<std::uint32_t> corners_;
  render::Bounds bounds_;
  mutable std::optional<RayTree> tree_;
  mutable std::optional<std::vector<render::Vec3f>> outline_;
};

}  // namespace footwall::ui
