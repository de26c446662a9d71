// The small survey whose bytes are written down, and the hash of all that it gives.
#pragma once
#include <array>
#include <bit>
#include <span>
#include <string>
#include <vector>

#include "engine/synthetic/faulted.h"
#include "storage/base/hash.h"

namespace footwall::synthetic {

inline Options small_survey() {
  Options options;
  options.size = {48, 40, 56};
  options.seed = 7;
  options.pillar_every_lines = 5;
  return options;
}

inline std::vector<float> all_of(const FaultedSurvey& survey) {
  std::vector<float> values(static_cast<std::size_t>(survey.geometry().box().count()));
  survey.fill(survey.geometry().box(), values);
  return values;
}

inline std::string hash_of_voxels(const FaultedSurvey& survey) {
  return to_hex(hash64(std::as_bytes(std::span<const float>(all_of(survey)))));
}

inline std::string hash_of_faults(const FaultedSurvey& survey) {
  Hasher hasher;
  const auto add = [&](double value) {
    const std::array<double, 1> bits{value};
    hasher.add(std::as_bytes(std::span(bits)));
  };
  const auto add_point = [&](const survey::WorldPoint& p) {
    add(p.x);
    add(p.y);
    add(p.z);
  };
  for (const Fault& fault : survey.faults()) {
    for (const survey::WorldPoint& p : fault.truth.vertices) add_point(p);
    for (const auto& triangle : fault.truth.triangles) {
      for (const std::int32_t corner : triangle) add(corner);
    }
    for (const survey::Pillar& pillar : fault.pillars) {
      for (const survey::PillarNode& node : pillar.nodes) add_point(node.position);
    }
  }
  return to_hex(hasher.value());
}

}  // namespace footwall::synthetic
