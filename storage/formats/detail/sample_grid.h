// Volumes as plain samples in a file, in any order of the axes: blocks out of them, and whole ones into them.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "storage/base/job_context.h"
#include "storage/formats/detail/output_file.h"
#include "storage/survey/box.h"

namespace footwall::formats::detail {

// Survey axes (0 inline, 1 crossline, 2 sample) from the slowest to the fastest in the file.
using AxisOrder = std::array<int, 3>;

// How one sample is stored.
struct Element {
  std::int64_t size;  // bytes
  // Puts `count` samples from `in` to out[0], out[stride], ...
  void (*decode)(const std::byte* in, std::int64_t count, float* out, std::int64_t stride);
};

// Fills the bytes that start at an offset among all samples.
using ReadAt = std::function<void(std::int64_t offset, std::span<std::byte> bytes)>;
// values: box.count() floats, [inline][crossline][sample]; the caller has checked box and size. Reads at most
// 16 MiB at a time where a row of the fastest axis is not larger.
void read_block(const ReadAt& read_at, const survey::Index& dims, const AxisOrder& order,
                const Element& element, const survey::Box& box, std::span<float> values);

using BoxReader = std::function<void(const survey::Box&, std::span<float>)>;
// Writes all samples as float32 in the given order; read is asked for slabs along the slowest axis, `thick`
// planes at a time where these are at most 128 MiB, fewer or a part of a plane otherwise. Reports progress
// as `phase`.
void write_samples(OutputFile& out, const survey::Index& dims, const AxisOrder& order, bool big_endian,
                   const BoxReader& read, std::int64_t thick, std::string_view phase, const JobContext& job);

}  // namespace footwall::formats::detail
