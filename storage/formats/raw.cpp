#include "storage/formats/raw.h"

#include <fmt/format.h>

#include <vector>

#include "storage/base/error.h"
#include "storage/formats/detail/bytes.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/detail/read_only_file.h"

namespace footwall::formats::raw {
namespace {

// Voxels of dims; throws where a count is below 1 or the bytes would not fit into 63 bits.
std::int64_t checked_count(const survey::Index& dims) {
  std::int64_t bytes = sizeof(float);
  for (const std::int64_t n : dims) {
    if (n < 1 || __builtin_mul_overflow(bytes, n, &bytes)) {
      throw Error(ErrorCode::kInvalid, fmt::format("{} x {} x {} is no volume", dims[0], dims[1], dims[2]),
                  "dims are inlines, crosslines, samples, each 1 or more");
    }
  }
  return bytes / static_cast<std::int64_t>(sizeof(float));
}

template <bool kSwap>
void decode(const std::byte* in, std::int64_t count, float* out, std::int64_t stride) {
  for (std::int64_t n = 0; n < count; ++n) {
    out[n * stride] = detail::load<float, kSwap>(in + n * static_cast<std::int64_t>(sizeof(float)));
  }
}

}  // namespace

AxisOrder axis_order_from(std::string_view text) {
  AxisOrder order{};
  std::array<bool, 3> seen{};
  bool good = text.size() == 3;
  for (std::size_t n = 0; good && n < 3; ++n) {
    const int axis = text[n] - 'i';
    good = axis >= 0 && axis < 3 && !seen[static_cast<std::size_t>(axis)];
    if (!good) break;
    seen[static_cast<std::size_t>(axis)] = true;
    order[n] = axis;
  }
  if (!good) {
    throw Error(ErrorCode::kUsage, fmt::format("'{}' is no axis order", text),
                "name the axes from slowest to fastest: i inline, j crossline, k sample, as in ijk or kji");
  }
  return order;
}

std::string name_of(const AxisOrder& order) {
  std::string name;
  for (const int axis : order) name += static_cast<char>('i' + axis);
  return name;
}

struct RawFile::State {
  detail::ReadOnlyFile file;
  survey::Index dims;
  AxisOrder order;
  detail::Element element;
};

RawFile::RawFile(const std::filesystem::path& path, const survey::Index& dims, AxisOrder order,
                 bool big_endian)
    : state_(new State{detail::ReadOnlyFile(path),
                       dims,
                       order,
                       {sizeof(float), big_endian ? decode<true> : decode<false>}}) {
  const std::int64_t bytes = checked_count(dims) * static_cast<std::int64_t>(sizeof(float));
  if (state_->file.size() != bytes) {
    throw Error(ErrorCode::kFormat,
                fmt::format("{} has {} bytes, {} x {} x {} float32 samples need {}", path.string(),
                            state_->file.size(), dims[0], dims[1], dims[2], bytes),
                "check the dims; the file must hold 4 bytes a sample and no header");
  }
}
RawFile::RawFile(RawFile&&) noexcept = default;
RawFile& RawFile::operator=(RawFile&&) noexcept = default;
RawFile::~RawFile() = default;

const survey::Index& RawFile::dims() const {
  return state_->dims;
}

void RawFile::read_block(const survey::Box& box, std::span<float> values) const {
  const State& state = *state_;
  require(!box.empty() && survey::intersection(box, {{0, 0, 0}, state.dims}) == box,
          "the box lies inside the volume");
  require(values.size() == static_cast<std::size_t>(box.count()), "values hold one float a voxel of the box");
  detail::read_block(
      [&](std::int64_t offset, std::span<std::byte> bytes) { state.file.read_at(offset, bytes); }, state.dims,
      state.order, state.element, box, values);
}

void write(const std::filesystem::path& path, const survey::Index& dims, const BoxReader& read,
           std::int64_t chunk_lines, const JobContext& job, const WriteOptions& options) {
  checked_count(dims);
  detail::OutputFile out(path);
  detail::write_samples(out, dims, options.order, options.big_endian, read, chunk_lines, "write raw", job);
  out.commit();
}

}  // namespace footwall::formats::raw
