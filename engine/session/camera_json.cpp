#include "engine/session/camera_json.h"

#include <nlohmann/json.hpp>

namespace footwall::session {
namespace {

using Json = nlohmann::json;

Json json_of(const render::Vec3& v) {
  return {v.x, v.y, v.z};
}
render::Vec3 vector_from(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace

Json json_of(const render::Camera& camera) {
  return {{"view_projection", camera.view_projection},
          {"eye", json_of(camera.eye)},
          {"right", json_of(camera.right)},
          {"up", json_of(camera.up)},
          {"forward", json_of(camera.forward)},
          {"perspective", camera.perspective}};
}

Json json_of(const render::Placement& placement) {
  return {{"linear", placement.linear}, {"shift", json_of(placement.shift)}};
}

render::Camera camera_from(const Json& json) {
  render::Camera camera;
  camera.view_projection = json.at("view_projection").get<render::Matrix4>();
  camera.eye = vector_from(json.at("eye"));
  camera.right = vector_from(json.at("right"));
  camera.up = vector_from(json.at("up"));
  camera.forward = vector_from(json.at("forward"));
  camera.perspective = json.at("perspective").get<bool>();
  return camera;
}

render::Placement placement_from(const Json& json) {
  render::Placement placement;
  placement.linear = json.at("linear").get<std::array<double, 9>>();
  placement.shift = vector_from(json.at("shift"));
  return placement;
}

}  // namespace footwall::session
