#include "engine/service/resident/memory_needs.h"

#include <algorithm>

#include "engine/service/engine.pb.h"

namespace footwall::service {
namespace {

// A node of a map with name and corners, and its hash on the way.
constexpr std::int64_t kModelFace = 128;
// Parsed from the message, in the model, as it was before, and its name with up to four extractions.
constexpr std::int64_t kEditedFace = 64 + kModelFace + 128 + 4 * 80;
// Name, corners, numbers, place and rank, twice: in all and in the last update.
constexpr std::int64_t kExtractedStays = 512;
// Lists of faces and numbers, exact sums and messages.
constexpr std::int64_t kExtractedPasses = 768;

// An isosurface that crosses a brick of 8 x 8 x 8 cells crosses some 1.5 x 8 x 8 of them, with two triangles
// each, and half as many vertices as triangles.
constexpr std::int64_t kTrianglesOfBrick = 192;
// Corner numbers, and half of a vertex with its normal; rooms are at most twice as large.
constexpr std::int64_t kTriangleExtracted = 2 * (12 + 12);
// Keys, the welded part, what goes out and what comes in.
constexpr std::int64_t kTriangleSent = 8 + 40 + 2 * 24 + 24;
// Projected.
constexpr std::int64_t kTriangleDrawn = 24;
// Nearest triangle and colour, and as much on its way to another rank.
constexpr std::int64_t kPixel = 2 * (8 + 4);
// Depth and colour on rank 0: in the layer, as rows, packed.
constexpr std::int64_t kPixelSent = 12 + 8 + 8;
// See ParallelOptions::block_cells.
constexpr std::int64_t kBlockBytes = std::int64_t{64} << 20;

std::int64_t samples_bytes(const survey::Index& dims) {
  return dims[0] * dims[1] * dims[2] * static_cast<std::int64_t>(sizeof(float));
}

std::int64_t share(std::int64_t all, int ranks) {
  return (all + ranks - 1) / ranks;
}

}  // namespace

std::int64_t model_bytes(std::int64_t faces) {
  return kModelFace * faces;
}

std::int64_t edit_bytes(const v1::EditBatch& batch, std::int64_t faces_of_model) {
  std::int64_t faces = 0;
  for (const v1::Edit& edit : batch.edits()) {
    faces += edit.put().faults_size() + edit.remove().faults_size() + edit.replace().faces().faults_size();
    if (edit.has_replace() || edit.clear()) faces += faces_of_model;
  }
  return kEditedFace * faces;
}

std::int64_t extraction_stays(std::int64_t faces) {
  return kExtractedStays * faces;
}

std::int64_t extraction_passes(std::int64_t faces) {
  return kExtractedPasses * faces;
}

std::int64_t expected_triangles(const isosurface::Bricks& bricks, float isovalue) {
  std::int64_t active = 0;
  for (std::size_t n = 0; n < bricks.min.size(); ++n) {
    if (bricks.min[n] < isovalue && isovalue <= bricks.max[n]) ++active;
  }
  return kTrianglesOfBrick * active;
}

std::int64_t surface_extraction_bytes(std::int64_t triangles, const survey::Index& dims, int ranks) {
  return kTriangleExtracted * share(triangles, ranks) + std::min(kBlockBytes, samples_bytes(dims));
}

std::int64_t surface_sending_bytes(std::int64_t triangles, int ranks) {
  return kTriangleSent * share(triangles, ranks);
}

std::int64_t picture_bytes(std::int64_t triangles, std::int64_t pixels, int rank, int ranks) {
  return kTriangleDrawn * share(triangles, ranks) + (kPixel + (rank == 0 ? kPixelSent : 0)) * pixels;
}

std::int64_t visible_sample_bytes(const survey::Index& dims, int ranks) {
  return 3 * share(samples_bytes(dims), ranks) / 2;
}

}  // namespace footwall::service
