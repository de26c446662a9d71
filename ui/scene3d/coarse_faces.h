// Fewer faces in the place of a mesh, for while the camera moves.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/vector.h"

namespace footwall::ui {

// Some of a mesh's faces, after near vertices were made one.
struct CoarseFaces {
  std::vector<std::uint32_t> corners;  // three vertices of the mesh per face
  std::vector<std::uint32_t> faces;    // the mesh's face whose colour each takes
};

// At most `most` faces, and not many fewer where the surface lets it; all of them where there are not more.
// corners: three vertices per face; bounds: of the finite positions.
CoarseFaces coarse_faces(std::span<const render::Vec3f> positions, std::span<const std::uint32_t> corners,
                         const render::Bounds& bounds, std::size_t most);

}  // namespace footwall::ui
