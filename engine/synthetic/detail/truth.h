// The faults of a structure as surfaces and as picked pillars.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/synthetic/detail/sheet.h"
#include "engine/synthetic/detail/structure.h"

namespace footwall::synthetic::detail {

enum class FaultKind : std::uint8_t { kPlanar, kListric, kTwisted };
inline constexpr FaultKind kFaultKinds[] = {FaultKind::kPlanar, FaultKind::kListric, FaultKind::kTwisted};
std::string_view name_of(FaultKind kind);

// The fault inside [0, n-1] on every axis; empty in a structure without faults.
Sheet true_sheet(const Structure& structure, const survey::Index& size, FaultKind kind);

struct Picking {
  std::int64_t every_lines = 16;
  double jitter_voxels = 1;
  std::uint64_t seed = 1;
};
// every_lines made smaller where a survey would otherwise see fewer than four pillars, larger beyond 1024 of
// them.
std::int64_t effective_spacing(const survey::Index& size, FaultKind kind, std::int64_t every_lines);

using PickedPillar = std::vector<survey::IndexPoint>;
// Pillars of at least two nodes, one on every n-th line from the first, nodes about 24 samples apart.
std::vector<PickedPillar> picked_pillars(const Structure& structure, const survey::Index& size,
                                         FaultKind kind, const Picking& picking);

}  // namespace footwall::synthetic::detail
