// What tests of meshes over ranks share.
#pragma once
#include <gtest/gtest.h>

#include <utility>

#include "engine/isosurface/parallel/collect.h"
#include "engine/isosurface/parallel/weld.h"
#include "engine/isosurface/plane.h"
#include "mpi/isosurface/volume_in_memory.h"

namespace footwall::isosurface {

inline constexpr float kIsovalue = 0;

class MeshCase : public testing::Test {
 protected:
  MeshCase() : world(MPI_COMM_WORLD) {}

  Extraction extracted(const TestVolume& volume, const Pillars& pillars, const ParallelOptions& options) {
    std::vector<float> room;
    Extraction extraction;
    extract_parallel(world, pillars, field_of(volume, room), kIsovalue, options, {}, extraction);
    return extraction;
  }
  MeshPart welded(const TestVolume& volume, const Pillars& pillars, const ParallelOptions& options) {
    Extraction extraction = extracted(volume, pillars, options);
    return weld(world, pillars, options.normals, extraction.pieces);
  }
  // The whole mesh on rank 0, in the order of its numbers.
  Surface gathered(MeshPart part, bool normals = true) {
    Surface whole;
    const Bounds vertices = all_on_first(part.all_vertices, world.size());
    const Bounds triangles = all_on_first(part.all_triangles, world.size());
    const auto own = [&](const auto& values) { return values.all().first(values.empty() ? 0 : part.own); };
    const Surface& mesh = part.mesh;
    whole.positions = collect<Point>(world, part.vertex_runs, own(mesh.positions), vertices);
    if (normals) whole.normals = collect<Point>(world, part.vertex_runs, own(mesh.normals), vertices);
    whole.keys = collect<VertexKey>(world, part.vertex_runs, own(mesh.keys), vertices);
    for (Triangle& triangle : part.mesh.triangles.all())
      triangle = {part.numbers[triangle[0]], part.numbers[triangle[1]], part.numbers[triangle[2]]};
    whole.triangles = collect<Triangle>(world, part.triangle_runs, mesh.triangles.all(), triangles);
    return whole;
  }

  comm::Communicator world;
};

inline ParallelOptions with_keys() {
  ParallelOptions options;
  options.kernel = &extract_plane;
  options.keys = true;
  return options;
}

inline Surface serial(const TestVolume& volume) {
  std::vector<float> room;
  ExtractOptions options;
  options.keys = true;
  Surface surface;
  extract_plane(volume.whole(room), kIsovalue, options, surface);
  return surface;
}

struct Shape {
  survey::Index dims;
  Interleaving interleaving;
};

// More pillars than cells, empty ranks, volumes without a cell.
inline std::vector<Shape> shapes() {
  return {{{17, 14, 23}, {1, 1, 1}}, {{17, 14, 23}, {3, 2, 1}}, {{17, 14, 23}, {2, 3, 4}},
          {{9, 30, 11}, {8, 8, 8}},  {{2, 2, 2}, {2, 2, 2}},    {{3, 40, 5}, {1, 4, 2}},
          {{1, 12, 9}, {2, 2, 1}},   {{12, 1, 9}, {1, 1, 2}},   {{6, 7, 1}, {1, 1, 1}},
          {{33, 18, 40}, {1, 1, 3}}};
}

}  // namespace footwall::isosurface
