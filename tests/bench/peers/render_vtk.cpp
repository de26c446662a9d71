// VTK's OpenGL renderer (llvmpipe where there is no graphics card) against footwall::render on the same mesh,
// in turns in one run:
//
//   xvfb-run render_vtk [--mesh F.ply|F.stl | --sphere TRIANGLES] [--width W] [--height H] [--threads T]
//   [--repeat R]
//
// Each frame has another azimuth and ends with RGBA and depth in memory. One sample a pixel, Gouraud, a
// headlight, on both sides. LP_NUM_THREADS limits llvmpipe's threads. Vertices are in the card's (or
// llvmpipe's) buffers, and in our arrays, before the first frame.
#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/render/surface_frame.h"
#include "storage/formats/plain_mesh.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace {

using namespace footwall;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

formats::PlainMesh sphere(std::int64_t triangles) {
  formats::PlainMesh mesh;
  const int belts = std::max(3, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 4))));
  const int around = 2 * belts;
  for (int c = 0; c <= belts; ++c) {
    for (int n = 0; n < around; ++n) {
      const double a = std::numbers::pi * c / belts;
      const double b = 2 * std::numbers::pi * n / around;
      mesh.positions.push_back({static_cast<float>(std::sin(a) * std::cos(b)),
                                static_cast<float>(std::sin(a) * std::sin(b)),
                                static_cast<float>(std::cos(a))});
    }
  }
  mesh.normals = mesh.positions;
  for (int belt = 0; belt < belts; ++belt) {
    for (int n = 0; n < around; ++n) {
      const int upper = belt * around + n;
      const int next = belt * around + (n + 1) % around;
      if (belt > 0) mesh.triangles.push_back({upper, upper + around, next});
      if (belt + 1 < belts) mesh.triangles.push_back({next, upper + around, next + around});
    }
  }
  return mesh;
}

class Vtk {
 public:
  Vtk(const formats::PlainMesh& mesh, int width, int height) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> normals;
    vtkNew<vtkCellArray> cells;
    points->SetDataTypeToFloat();
    normals->SetNumberOfComponents(3);
    for (const auto& p : mesh.positions) points->InsertNextPoint(p.data());
    for (const auto& n : mesh.normals) normals->InsertNextTuple(n.data());
    for (const auto& t : mesh.triangles) {
      const vtkIdType corners[] = {t[0], t[1], t[2]};
      cells->InsertNextCell(3, corners);
    }
    data_->SetPoints(points);
    data_->SetPolys(cells);
    data_->GetPointData()->SetNormals(normals);
    mapper_->SetInputData(data_);
    actor_->SetMapper(mapper_);
    actor_->GetProperty()->SetInterpolationToGouraud();
    renderer_->AddActor(actor_);
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(width, height);
    window_->AddRenderer(renderer_);
    renderer_->ResetCamera();
  }
  void frame() {
    renderer_->GetActiveCamera()->Azimuth(1);
    window_->Render();
    const int* size = window_->GetSize();
    window_->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, rgba_);
    window_->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depth_);
  }
  std::int64_t seen() {
    std::int64_t count = 0;
    for (vtkIdType n = 0; n < depth_->GetNumberOfTuples(); ++n) count += depth_->GetValue(n) < 1 ? 1 : 0;
    return count;
  }

 private:
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkUnsignedCharArray> rgba_;
  vtkNew<vtkFloatArray> depth_;
};

class Ours {
 public:
  Ours(const formats::PlainMesh& mesh, int width, int height, int threads)
      : width_(width), height_(height), threads_(threads), window_(width, height) {
    for (const auto& p : mesh.positions) positions_.emplace_back(p[0], p[1], p[2]);
    for (const auto& n : mesh.normals) normals_.emplace_back(n[0], n[1], n[2]);
    triangles_.assign(mesh.triangles.begin(), mesh.triangles.end());
    bounds_ = {{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
    for (const render::Vec3f& p : positions_) {
      const render::Vec3 q(p);
      bounds_.lo = {std::min(bounds_.lo.x, q.x), std::min(bounds_.lo.y, q.y), std::min(bounds_.lo.z, q.z)};
      bounds_.hi = {std::max(bounds_.hi.x, q.x), std::max(bounds_.hi.y, q.y), std::max(bounds_.hi.z, q.z)};
    }
    const std::size_t pixels = window_.pixels().size();
    rgba_.resize(pixels);
    depth_.resize(pixels);
  }
  void frame() {
    azimuth_ += 1;
    const render::IdRun run{0, 0};
    const render::LitSurface surface{render::hex(0xffffff), {}, positions_, normals_, triangles_,
                                     std::span(&run, 1)};
    const render::Camera camera =
        render::Camera::look(azimuth_, 10, kZoom, bounds_, static_cast<double>(width_) / height_, true);
    frame_.project(std::span(&surface, 1), camera, width_, height_, threads_);
    window_.clear();
    frame_.rasterize(window_, threads_);
    frame_.shade(window_, rgba_, threads_);
    for (std::size_t n = 0; n < depth_.size(); ++n) depth_[n] = render::depth_of(window_.pixels()[n]);
  }
  std::int64_t seen() const {
    return std::count_if(depth_.begin(), depth_.end(), [](float d) { return d < 1; });
  }

 private:
  // So that both show a sphere as large.
  static constexpr double kZoom = 0.776;

  int width_;
  int height_;
  int threads_;
  double azimuth_ = 0;
  render::Bounds bounds_;
  std::vector<render::Vec3f> positions_;
  std::vector<render::Vec3f> normals_;
  std::vector<render::TriangleIndices> triangles_;
  render::SurfaceFrame frame_;
  render::VisibilityBuffer window_;
  std::vector<render::Rgba> rgba_;
  std::vector<float> depth_;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("VTK's renderer against ours on one mesh.");
  std::string mesh_file;
  std::int64_t triangles = 1'000'000;
  int width = 1024;
  int height = 1024;
  int threads = 1;
  int repeat = 9;
  app.add_option("--mesh", mesh_file);
  app.add_option("--sphere", triangles);
  app.add_option("--width", width);
  app.add_option("--height", height);
  app.add_option("--threads", threads);
  app.add_option("--repeat", repeat);
  CLI11_PARSE(app, argc, argv);
  const formats::PlainMesh mesh = mesh_file.empty() ? sphere(triangles) : formats::read_plain_mesh(mesh_file);
  Vtk vtk(mesh, width, height);
  Ours ours(mesh, width, height, threads);
  vtk.frame();
  ours.frame();
  std::vector<double> theirs_ms;
  std::vector<double> ours_ms;
  for (int n = 0; n < repeat; ++n) {
    const double start = now();
    vtk.frame();
    const double middle = now();
    ours.frame();
    theirs_ms.push_back(1e3 * (middle - start));
    ours_ms.push_back(1e3 * (now() - middle));
  }
  fmt::print(
      "{} triangles, {} x {}: VTK {:.1f} ms ({} pixels seen), ours {:.1f} ms ({} pixels seen), {:.1f} times "
      "as fast\n",
      mesh.triangles.size(), width, height, median(theirs_ms), vtk.seen(), median(ours_ms), ours.seen(),
      median(theirs_ms) / median(ours_ms));
}
