// The loops behind samples.h, compiled for each instruction set and chosen at run time.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace footwall::formats::segy {

// Decodes out.size() samples of format `code` (one that samples.h lists) from `in`; `swap` where the file's
// byte order is not the machine's. Rounds to the nearest float32, ties to even; returns how many were finite
// but beyond float32 and became +-FLT_MAX. The same bits on every instruction set.
std::int64_t decode(int code, bool swap, const std::byte* in, std::span<float> out);

}  // namespace footwall::formats::segy
