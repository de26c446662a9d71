// The survey's box: its edges, a quiet grid on its floor, and axes labelled with line numbers and z.
#pragma once
#include <array>
#include <vector>

#include "engine/render/camera.h"
#include "engine/render/scene.h"
#include "engine/render/scene_frame.h"

namespace footwall::render {

// Adds lines and labels for the box as the camera sees it: axes stand on edges at the outline, text outside.
void add_axes(Scene& scene, const SceneFrame& frame, const Camera& camera, int width, int height);

// The four edges of a box along one axis: their first corners (the axis' bit is 0).
std::array<unsigned, 4> edges_along(unsigned axis);

// Round numbers from lo to hi, about `count` of them, at least `least_step` apart.
std::vector<double> round_numbers(double lo, double hi, int count, double least_step);

}  // namespace footwall::render
