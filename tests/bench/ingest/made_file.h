// SEG-Y files of any size whose every sample is known without reading them: IBM float32, revision 1.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "storage/survey/box.h"

namespace footwall::bench {

// Which traces follow each other in the file.
enum class TraceOrder : std::uint8_t { kInline, kCrossline, kShuffled };
// "inline", "crossline", "shuffled"; throws kUsage for anything else.
TraceOrder trace_order_from(std::string_view name);

// The sample at index (i, j, k): bell-shaped with a standard deviation near 1000, in steps of 1/8, so that
// IBM and IEEE both hold it exactly.
float made_sample(std::int64_t i, std::int64_t j, std::int64_t k);

// Writes the file and puts it on the disk. dims: inlines, crosslines, samples (at most 32,767). Lines are
// numbered from 1, bins are 25 m x 12.5 m, samples 4 ms apart. Throws kIo, kUsage.
void make_segy(const std::filesystem::path& path, const survey::Index& dims, TraceOrder order);

}  // namespace footwall::bench
