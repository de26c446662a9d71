// The yardstick: Debian's libsegyio reading every trace of a file. Only the bench links it, and only where it
// is found.
#pragma once
#include <cstdint>
#include <filesystem>

namespace footwall::bench {

struct SegyioResult {
  std::int64_t traces = 0;
  std::uint32_t bit_sum = 0;  // of all samples' float32 bit patterns, modulo 2^32: a sum in any order
};
// Reads and converts each trace to float32, header too, as an importer must. Throws kIo, kFormat.
SegyioResult read_with_segyio(const std::filesystem::path& path, bool mapped);

}  // namespace footwall::bench
