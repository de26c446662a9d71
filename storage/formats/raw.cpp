#include "storage/formats/raw.h"

#include <fmt/format.h>

#include <bit>
#include <vector>

#include "storage/base/error.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/detail/read_only_file.h"

namespace footwall::formats::raw {
namespace {

static_assert(std::endian::native == std::endian::little);

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

struct RawFile::State {
  detail::ReadOnlyFile file;
  survey::Index dims;
  AxisOrder order;
};

RawFile::RawFile(const std::filesystem::path& path, const survey::Index& dims, AxisOrder order)
    : state_(new State{detail::ReadOnlyFile(path), dims, order}) {
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
  const survey::Index& dims = state_->dims;
  require(!box.empty() && survey::intersection(box, {{0, 0, 0}, dims}) == box,
          "the box lies inside the volume");
  require(values.size() == static_cast<std::size_t>(box.count()), "values hold one float a voxel of the box");
  const auto [slow, middle, fast] = state_->order;
  const survey::Index in_block{box.size(1) * box.size(2), box.size(2), 1};  // strides of values
  const auto run = static_cast<std::size_t>(box.size(fast));
  // One read covers a plane of the two faster axes, from its first to its last wanted row, unless most of it
  // is not wanted; then each row is a read of its own.
  const std::int64_t rows = box.size(middle);
  const bool whole = 2 * box.size(fast) >= dims[fast] && rows * dims[fast] <= (std::int64_t{1} << 22);
  const std::int64_t rows_a_read = whole ? rows : 1;
  std::vector<float> buffer(static_cast<std::size_t>((rows_a_read - 1) * dims[fast]) + run);
  for (std::int64_t a = box.lo[slow]; a < box.hi[slow]; ++a) {
    for (std::int64_t first = box.lo[middle]; first < box.hi[middle]; first += rows_a_read) {
      const std::int64_t place = (a * dims[middle] + first) * dims[fast] + box.lo[fast];
      state_->file.read_at(place * static_cast<std::int64_t>(sizeof(float)),
                           std::as_writable_bytes(std::span(buffer)));
      for (std::int64_t row = 0; row < rows_a_read; ++row) {
        const float* from = buffer.data() + row * dims[fast];
        float* to = values.data() + (a - box.lo[slow]) * in_block[slow] +
                    (first + row - box.lo[middle]) * in_block[middle];
        for (std::size_t n = 0; n < run; ++n) to[static_cast<std::int64_t>(n) * in_block[fast]] = from[n];
      }
    }
  }
}

void write(const std::filesystem::path& path, const survey::Index& dims, const BoxReader& read,
           std::int64_t chunk_lines, const JobContext& job) {
  checked_count(dims);
  detail::OutputFile out(path);
  const std::int64_t step = std::clamp<std::int64_t>(chunk_lines, 1, dims[0]);
  std::vector<float> planes;
  for (std::int64_t i = 0; i < dims[0]; i += step) {
    const survey::Box box{{i, 0, 0}, {std::min(i + step, dims[0]), dims[1], dims[2]}};
    job.report(static_cast<double>(i) / static_cast<double>(dims[0]), "write raw",
               fmt::format("{} of {} inlines", i, dims[0]));
    planes.resize(static_cast<std::size_t>(box.count()));
    read(box, planes);
    out.write(std::as_bytes(std::span<const float>(planes)));
  }
  out.commit();
  job.report(1, "write raw", fmt::format("{0} of {0} inlines", dims[0]));
}

}  // namespace footwall::formats::raw
