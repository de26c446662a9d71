#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/tasks/isosurface_ranks/ranks_run.h"
#include "storage/base/splitmix64.h"

namespace footwall::tasks {
namespace {

struct Ball {
  std::array<float, 3> centre;
  float radius = 0;
};

// Small balls around the middle, and a few far out.
std::vector<Ball> balls() {
  constexpr int kBalls = 60;
  constexpr int kOutliers = 6;
  SplitMix64 random(2026);
  const auto between = [&](double lo, double hi) {
    return static_cast<float>(lo + (hi - lo) * random.unit());
  };
  std::vector<Ball> all;
  for (int n = 0; n < kBalls; ++n) {
    const bool outlier = n < kOutliers;
    const double half = outlier ? 110 : 44;
    all.push_back(
        {{between(128 - half, 128 + half), between(128 - half, 128 + half), between(8, 32)}, between(5, 9)});
  }
  return all;
}

}  // namespace

std::vector<float> central_volume() {
  const survey::Index& n = kCentralSize;
  std::vector<float> values(static_cast<std::size_t>(n[0] * n[1] * n[2]), -1);
  // The largest of the balls' own fields, each 0 on its surface: unions without seams.
  for (const Ball& ball : balls()) {
    std::size_t at = 0;
    for (std::int64_t i = 0; i < n[0]; ++i) {
      for (std::int64_t j = 0; j < n[1]; ++j) {
        for (std::int64_t k = 0; k < n[2]; ++k, ++at) {
          const float x = static_cast<float>(i) - ball.centre[0];
          const float y = static_cast<float>(j) - ball.centre[1];
          const float z = static_cast<float>(k) - ball.centre[2];
          const float square = ball.radius * ball.radius;
          values[at] = std::max(values[at], 1 - (x * x + y * y + z * z) / square);
        }
      }
    }
  }
  return values;
}

}  // namespace footwall::tasks
