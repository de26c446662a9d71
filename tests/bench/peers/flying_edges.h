// vtkFlyingEdges3D behind a face of plain types: VTK 9.1's headers are not C++20.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class FlyingEdges {
 public:
  // values: samples of dims[0] x dims[1] x dims[2], the last axis the fastest; kept, not copied.
  FlyingEdges(std::vector<float>& values, const std::array<std::int64_t, 3>& dims, float isovalue,
              bool normals, int threads);
  ~FlyingEdges();

  void run();      // with a new filter if there is none
  void release();  // the filter and its output
  std::int64_t vertices() const;
  std::int64_t triangles() const;
  static std::string version();  // of VTK, and how it makes threads

 private:
  struct Vtk;
  std::unique_ptr<Vtk> vtk_;
};
