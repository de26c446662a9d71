// A camera for the service's tests.
#pragma once
#include "engine/service/engine.pb.h"

namespace footwall::service {

// The box from 0 to 23 fills the picture, seen along samples.
inline v1::Camera camera_along_samples() {
  v1::Camera camera;
  for (int n = 0; n < 16; ++n)
    camera.add_view_projection(n % 5 == 0 ? (n == 15 ? 1 : 2.0 / 23) : (n % 4 == 3 ? -1 : 0));
  for (const double each : {11.0, 9.0, 1000.0}) camera.add_eye(each);
  for (const double each : {1.0, 0.0, 0.0}) camera.add_right(each);
  for (const double each : {0.0, 1.0, 0.0}) camera.add_up(each);
  for (const double each : {0.0, 0.0, -1.0}) camera.add_forward(each);
  return camera;
}

}  // namespace footwall::service
