// A scene through a camera, as pixels.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/render/camera.h"
#include "engine/render/scene.h"
#include "engine/render/surface_layer.h"
#include "storage/base/job_context.h"

namespace footwall::render {

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height, row 0 on top, opaque
  std::vector<float> depth;        // width * height, OpenGL window depth at the pixel centres, 1 = background
};

// Draws with 3x3 samples per pixel, in bands of rows so that memory stays bounded; the pixels do not depend
// on `threads` (0 = all). Without a font on the machine the picture has no text, and one warning is logged.
// surfaces: drawn elsewhere through the same camera, kSamples times as many pixels each way; where both are
// as far away the scene is seen. Null: none. Throws Error kUsage for a size outside 1..kLargestPicture,
// kInvalid for a mesh that refers to vertices or colours that are not there, or a section without its
// samples, kCancelled.
Picture render(const Scene& scene, const Camera& camera, int width, int height, int threads,
               const SurfaceLayer* surfaces = nullptr, const JobContext& job = {});
inline constexpr int kLargestPicture = 8192;
// Of a pixel, each way. Odd, so that the middle one is its centre and the depth written is the picture's own.
inline constexpr int kSamples = 3;

}  // namespace footwall::render
