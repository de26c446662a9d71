// The camera that shows the survey's box as large as the picture has room for, labels included.
#pragma once
#include "engine/render/camera.h"
#include "engine/render/scene_frame.h"

namespace footwall::render {

// A part of the picture, in pixels from its upper left corner.
struct Room {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
};

struct Direction {
  double azimuth_degrees = 0;
  double elevation_degrees = 0;
  bool perspective = true;
};

// At zoom 1 all eight corners lie in the room, and the axes' numbers and titles with them as far as their
// text's estimated size tells; the room must have an area.
Camera fitted_camera(const SceneFrame& frame, const Direction& direction, double zoom, const Room& room,
                     int width, int height, double text_scale);

}  // namespace footwall::render
