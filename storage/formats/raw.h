// Raw float32 volumes: nothing but samples, in either byte order and any of the six axis orders; dims are
// told by the user.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "storage/base/job_context.h"
#include "storage/formats/detail/sample_grid.h"
#include "storage/survey/box.h"

namespace footwall::formats::raw {

// Survey axes (0 inline, 1 crossline, 2 sample) from the slowest to the fastest in the file.
using detail::AxisOrder;
inline constexpr AxisOrder kSampleFastest{0, 1, 2};
// "ijk" is the project's own order, "kji" has inlines fastest. Throws kUsage for anything but the six
// permutations.
AxisOrder axis_order_from(std::string_view text);
std::string name_of(const AxisOrder& order);

// Streams: blocks are read as they are asked for.
class RawFile {
 public:
  // dims: inlines, crosslines, samples. Throws kNotFound, kInvalid for dims below 1, kFormat naming both
  // sizes where the file does not have exactly dims[0] * dims[1] * dims[2] * 4 bytes.
  RawFile(const std::filesystem::path& path, const survey::Index& dims, AxisOrder order = kSampleFastest,
          bool big_endian = false);
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
using detail::BoxReader;
struct WriteOptions {
  AxisOrder order = kSampleFastest;
  bool big_endian = false;
};
// Writes float32 samples. read is asked for `chunk_lines` whole planes along the slowest axis at a time,
// fewer where these take more than 128 MiB (pass the volume's chunk size so that each chunk is read once).
// Throws kInvalid for dims below 1, kIo (a full disk leaves no file), whatever read throws, kCancelled.
void write(const std::filesystem::path& path, const survey::Index& dims, const BoxReader& read,
           std::int64_t chunk_lines = 1, const JobContext& job = {}, const WriteOptions& options = {});

}  // namespace footwall::formats::raw
