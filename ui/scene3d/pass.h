// How one picture of the scene is drawn: the camera, the target's size, and what is a pixel.
#pragma once
#include "engine/render/camera.h"

namespace footwall::ui {

struct Pass {
  render::Camera camera;      // of the target, which may be a part of the whole picture
  render::Matrix4 whole{};    // the whole picture's view_projection
  int width = 1, height = 1;  // of the target, device pixels
  int whole_width = 1, whole_height = 1;
  int left = 0, top = 0;  // of the target in the whole
  double pixel = 1;       // device pixels of one pixel
  double heights = 1;     // vertical exaggeration
  bool quick = false;     // while the camera moves
};

}  // namespace footwall::ui
