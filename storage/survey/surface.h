// A triangle surface as plain values, as files have it: nothing is promised about its topology.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::survey {

struct Surface {
  std::string name;
  std::vector<WorldPoint> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;  // indices into vertices, from 0
};

}  // namespace footwall::survey
