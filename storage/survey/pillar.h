// A pillar as plain values: an ordered polyline of nodes down a fault.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::survey {

enum class PillarKind : std::uint8_t { kInterpreted, kInterpolated, kSnapped };

constexpr std::string_view name_of(PillarKind kind) {
  switch (kind) {
    case PillarKind::kInterpolated:
      return "interpolated";
    case PillarKind::kSnapped:
      return "snapped";
    case PillarKind::kInterpreted:
      break;
  }
  return "interpreted";
}

struct PillarNode {
  std::int64_t id = 0;  // 0 = not stored yet
  WorldPoint position;  // as picked, never rounded
};

struct Pillar {
  std::int64_t id = 0;  // 0 = not stored yet
  PillarKind kind = PillarKind::kInterpreted;
  std::vector<PillarNode> nodes;
  // For interpolated pillars: the two picked neighbours and the parameter between them, 0 < t < 1.
  std::int64_t parent_a = 0;
  std::int64_t parent_b = 0;
  double parameter = 0;
};

}  // namespace footwall::survey
