#include "engine/tasks/detail/bench_service_pictures.h"

#include <array>
#include <chrono>

#include "engine/render/camera.h"
#include "engine/render/lit_surface.h"
#include "engine/tasks/detail/bench_service_inputs.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

constexpr int kPixels = 1024;
constexpr double kDegreesPerSide = 7;
constexpr std::uint32_t kColour = 0xffc06020U;

render::Camera camera_of(int side) {
  std::array<render::Vec3, 8> corners;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const auto at = [&](std::size_t axis) {
      return (n >> axis & 1) != 0 ? static_cast<double>(kSphereSize - 1) : 0.0;
    };
    corners[n] = {at(0), at(1), at(2)};
  }
  return render::Camera::look(30 + kDegreesPerSide * side, 25, 1, corners, 1, true);
}

v1::RenderRequest request_of(const std::string& volume, float value, int side) {
  v1::RenderRequest request;
  const render::Camera camera = camera_of(side);
  v1::Camera& to = *request.mutable_camera();
  for (const double each : camera.view_projection) to.add_view_projection(each);
  const auto add = [](const render::Vec3& v, auto* field) {
    for (const double each : {v.x, v.y, v.z}) field->Add(each);
  };
  add(camera.eye, to.mutable_eye());
  add(camera.right, to.mutable_right());
  add(camera.up, to.mutable_up());
  add(camera.forward, to.mutable_forward());
  to.set_perspective(camera.perspective);
  request.set_width(kPixels);
  request.set_height(kPixels);
  v1::DrawnIsosurface& surface = *request.add_isosurfaces();
  surface.set_volume(volume);
  surface.set_value(value);
  surface.set_colour(kColour);
  const render::Placement here;
  for (const double each : here.linear) surface.mutable_placement()->add_linear(each);
  for (int n = 0; n < 3; ++n) surface.mutable_placement()->add_shift(0);
  return request;
}

}  // namespace

double draw_side(service::EngineClient& client, const std::string& volume, float value, int side,
                 std::string& tiles, const JobContext& job) {
  const v1::RenderRequest request = request_of(volume, value, side);
  tiles.clear();
  const auto begun = std::chrono::steady_clock::now();
  client.render(
      request,
      [&](const v1::RenderReply& reply) {
        if (!reply.has_tile()) return;
        tiles += std::to_string(reply.tile().first_row()) + ":";
        tiles += reply.tile().colours();
        tiles += reply.tile().depths();
      },
      job);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  if (tiles.empty()) throw Error(ErrorCode::kInternal, "a picture of the sphere shows nothing");
  return took.count();
}

}  // namespace footwall::tasks
