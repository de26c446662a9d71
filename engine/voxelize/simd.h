// Applies FOOTWALL_SIMD (storage/base/simd.h) to Highway's run-time dispatch.
#pragma once
#include <optional>
#include <string>

#include "storage/base/simd.h"

namespace footwall::voxelize {

// Call before the first HWY_DYNAMIC_DISPATCH of a thread's work: restricts Highway, for the whole process, to
// what FOOTWALL_SIMD allows. Cheap after the first call. Throws Error kUsage for a value that is no level.
void apply_forced_simd();

// For tests: restricts the whole process to a level, or lifts the restriction. Not while other threads
// compute.
void limit_simd(std::optional<SimdLevel> level);

// What dispatch chooses now, e.g. "AVX3".
std::string simd_in_use();

}  // namespace footwall::voxelize
