// A unit square of two triangles, of areas 1/2 and 1/2, and a table of two faults.
#pragma once
#include <limits>

#include "storage/formats/mesh_table.h"

namespace footwall::formats {

inline MeshTable sample_mesh(const std::string& name = "F1") {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {name,
          {{458177.125, 7322538.712891, 1643.655884},
           {458178.125, 7322538.712891, 1643.655884},
           {458178.125, 7322539.712891, 1643.655884},
           {458177.125, 7322539.712891, 1643.655884},
           {0.1, 2, 3}},
          {{0, 1, 2}, {0, 2, 3}},
          {"p1:1", "p1:2"},
          {{"mean", {2, 4}}, {"variance", {kNone, 0.1}}, {"count", {7, 8}}}};
}

}  // namespace footwall::formats
