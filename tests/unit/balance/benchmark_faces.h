// Faces like those of seed 004's benchmarks: random meshes of triangles of mean area 1000.
#pragma once
#include <vector>

#include "engine/extract/face.h"
#include "engine/tasks/workload/grow.h"

namespace footwall::extract {

struct Benchmark {
  survey::Index dims;
  int faces;
};
inline constexpr Benchmark kBenchmarks[] = {
    {{100, 100, 50}, 5000}, {{200, 200, 100}, 10000}, {{400, 400, 200}, 15000}};

// 16 meshes; a part of the faces for quick tests.
inline std::vector<Face> benchmark_faces(const Benchmark& benchmark, int faces, std::uint64_t seed) {
  tasks::Grower grower(benchmark.dims, 1000, 10, seed);
  mesh::MeshSet meshes;
  std::vector<mesh::Operation> operations;
  for (int m = 0; m < 16; ++m) grower.grow(faces / 16, meshes, operations);
  std::vector<Face> made;
  for (const mesh::FaceKey& key : meshes.faces()) {
    made.push_back({key.mesh, 0, static_cast<std::int32_t>(key.face), meshes.triangle(key)});
  }
  return made;
}

}  // namespace footwall::extract
