// Raw float32 volumes: nothing but little-endian samples, in any of the six axis orders; dims are told by the
// user.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "storage/base/job_context.h"
#include "storage/survey/box.h"

namespace footwall::formats::raw {

// Survey axes (0 inline, 1 crossline, 2 sample) from the slowest to the fastest in the file.
using AxisOrder = std::array<int, 3>;
inline constexpr AxisOrder kSampleFastest{0, 1, 2};
// "ijk" is the project's own order, "kji" has inlines fastest. Throws kUsage for anything but the six
// permutations.
AxisOrder axis_order_from(std::string_view text);

// Streams: blocks are read as they are asked for.
class RawFile {
 public:
  // dims: inlines, crosslines, samples. Throws kNotFound, kInvalid for dims below 1, kFormat naming both
  // sizes where the file does not have exactly dims[0] * dims[1] * dims[2] * 4 bytes.
  RawFile(const std::filesystem::path& path, const survey::Index& dims, AxisOrder order = kSampleFastest);
  RawFile(RawFile&&) noexcept;
  RawFile& operator=(RawFile&&) noexcept;
  ~RawFile();

  const survey::Index& dims() const;
  // values: box.count() floats, [inline][crossline][sample], as they stand in the file (NaN included).
  // Throws kInternal for a box outside the dims or another span size, kIo, kCorrupt if the file has shrunk.
  void read_block(const survey::Box& box, std::span<float> values) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Fills values, [inline][crossline][sample], of the box.
using BoxReader = std::function<void(const survey::Box&, std::span<float>)>;
// Writes [inline][crossline][sample] little-endian float32. read is asked for boxes of `chunk_lines` whole
// crossline x sample planes at a time (pass the volume's chunk size in inlines so that each chunk is read
// once). Throws kInvalid for dims below 1, kIo (a full disk leaves no file), whatever read throws,
// kCancelled.
void write(const std::filesystem::path& path, const survey::Index& dims, const BoxReader& read,
           std::int64_t chunk_lines = 1, const JobContext& job = {});

}  // namespace footwall::formats::raw
