// Sample formats of SEG-Y and their conversion to float32.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace footwall::formats::segy {

struct SampleFormat {
  int code;
  int size;  // bytes a sample
  std::string_view name;
  // Decodes out.size() samples from `in`; returns how many were beyond float32 and became +-FLT_MAX.
  std::int64_t (*decode_big)(const std::byte* in, std::span<float> out);
  std::int64_t (*decode_little)(const std::byte* in, std::span<float> out);
};

// The row of a format code; nullptr for codes that cannot be read (4, gains of 1975, and those never
// assigned).
const SampleFormat* sample_format(int code);
// True for codes that the standard defines, also those that cannot be read.
bool is_defined_format(int code);

// IBM System/360 single precision: (-1)^s * (fraction / 2^24) * 16^(exponent - 64), exactly, normalised or
// not;
// +-infinity where float32 ends (the decoders above turn that into +-FLT_MAX and count it).
float ibm_to_float(std::uint32_t bits);

}  // namespace footwall::formats::segy
