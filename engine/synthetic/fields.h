// Volumes whose isosurfaces are typical of one thing or another, for measuring: the same bytes on every
// machine.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace footwall::synthetic {

struct SampledField {
  std::vector<float> values;  // size^3, [i][j][k]
  float isovalue = 0;         // whose surface it is made for
};

struct FieldKind {
  std::string_view name;
  std::string_view help;  // one line
  SampledField (*make)(std::int64_t size);
};

// sphere: 0.4 size less the distance from the centre; isovalue 0: one smooth surface in few cells.
// gyroid: sin x cos y + sin y cos z + sin z cos x, 8.38 periods along each axis; isovalue 0: many triangles.
// envelope: the envelope of a sum of 40 plane waves with periods of 8 to 28 samples along k and gentle dips,
// as of reflectors; isovalue 1.9 times the mean: many small bodies.
std::span<const FieldKind> field_kinds();
// Throws Error kUsage listing the names if there is none of that name, kUsage for sizes that are not 2 to
// 2048.
SampledField make_field(std::string_view name, std::int64_t size);

}  // namespace footwall::synthetic
