// Cameras and placements in the engine's job files.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "engine/render/camera.h"
#include "engine/render/lit_surface.h"

namespace footwall::session {

// {view_projection[16], eye, right, up, forward, perspective}
nlohmann::json json_of(const render::Camera& camera);
// {linear[9], shift}
nlohmann::json json_of(const render::Placement& placement);
// These let the JSON library's exceptions through.
render::Camera camera_from(const nlohmann::json& json);
render::Placement placement_from(const nlohmann::json& json);

}  // namespace footwall::session
