#include "storage/formats/detail/sample_grid.h"

#include <bit>
#include <vector>

#include "storage/formats/detail/bytes.h"

namespace footwall::formats::detail {
namespace {

constexpr std::int64_t kMostRead = std::int64_t{16} << 20;     // bytes
constexpr std::int64_t kMostWritten = std::int64_t{32} << 20;  // samples

survey::Index strides_of(const survey::Box& box) {
  return {box.size(1) * box.size(2), box.size(2), 1};
}

// The slab's samples from [inline][crossline][sample] into the file's order.
void reorder(const std::vector<float>& from, const survey::Box& box, const AxisOrder& order,
             std::vector<float>& to) {
  const survey::Index stride = strides_of(box);
  // No structured binding: clang refuses one inside a parallel loop.
  const int slow = order[0];
  const int middle = order[1];
  const int fast = order[2];
  const std::int64_t run = box.size(fast);
  const std::int64_t rows = box.size(slow) * box.size(middle);
#pragma omp parallel for schedule(static) if (box.count() > (1 << 16))
  for (std::int64_t row = 0; row < rows; ++row) {
    const std::int64_t a = row / box.size(middle);
    const std::int64_t b = row % box.size(middle);
    const float* source = from.data() + a * stride[slow] + b * stride[middle];
    float* target = to.data() + row * run;
    for (std::int64_t n = 0; n < run; ++n) target[n] = source[n * stride[fast]];
  }
}

}  // namespace

void read_block(const ReadAt& read_at, const survey::Index& dims, const AxisOrder& order,
                const Element& element, const survey::Box& box, std::span<float> values) {
  const auto [slow, middle, fast] = order;
  const survey::Index stride = strides_of(box);
  const std::int64_t run = box.size(fast);
  // One read covers rows of the two faster axes from the first to the last wanted sample, unless most of it
  // is not wanted; then each row is a read of its own.
  const std::int64_t fitting = std::max<std::int64_t>(1, kMostRead / (dims[fast] * element.size));
  const std::int64_t rows_a_read = 2 * run >= dims[fast] ? std::min(box.size(middle), fitting) : 1;
  std::vector<std::byte> buffer(
      static_cast<std::size_t>(((rows_a_read - 1) * dims[fast] + run) * element.size));
  for (std::int64_t a = box.lo[slow]; a < box.hi[slow]; ++a) {
    for (std::int64_t first = box.lo[middle]; first < box.hi[middle]; first += rows_a_read) {
      const std::int64_t rows = std::min(rows_a_read, box.hi[middle] - first);
      const std::int64_t place = (a * dims[middle] + first) * dims[fast] + box.lo[fast];
      const auto bytes = static_cast<std::size_t>(((rows - 1) * dims[fast] + run) * element.size);
      read_at(place * element.size, std::span(buffer).first(bytes));
      for (std::int64_t row = 0; row < rows; ++row) {
        float* to = values.data() + (a - box.lo[slow]) * stride[slow] +
                    (first + row - box.lo[middle]) * stride[middle];
        element.decode(buffer.data() + row * dims[fast] * element.size, run, to, stride[fast]);
      }
    }
  }
}

void write_samples(OutputFile& out, const survey::Index& dims, const AxisOrder& order, bool big_endian,
                   const BoxReader& read, std::int64_t thick, std::string_view phase, const JobContext& job) {
  const auto [slow, middle, fast] = order;
  const std::int64_t plane = dims[middle] * dims[fast];
  const std::int64_t planes =
      std::clamp<std::int64_t>(kMostWritten / plane, 1, std::max<std::int64_t>(1, thick));
  const std::int64_t rows =
      plane <= kMostWritten ? dims[middle] : std::max<std::int64_t>(1, kMostWritten / dims[fast]);
  const bool in_order = order == AxisOrder{0, 1, 2};
  std::vector<float> samples, ordered;
  for (std::int64_t a = 0; a < dims[slow]; a += planes) {
    for (std::int64_t b = 0; b < dims[middle]; b += rows) {
      const double done = static_cast<double>(a * dims[middle] + b) /
                          (static_cast<double>(dims[slow]) * static_cast<double>(dims[middle]));
      job.report(done, phase, fmt::format("{} of {} planes", a, dims[slow]));
      survey::Box box{{0, 0, 0}, dims};
      box.lo[slow] = a;
      box.hi[slow] = std::min(a + planes, dims[slow]);
      box.lo[middle] = b;
      box.hi[middle] = std::min(b + rows, dims[middle]);
      samples.resize(static_cast<std::size_t>(box.count()));
      read(box, samples);
      if (!in_order) {
        ordered.resize(samples.size());
        reorder(samples, box, order, ordered);
      }
      std::vector<float>& finished = in_order ? samples : ordered;
      if (big_endian) {
        for (float& value : finished) {
          value = std::bit_cast<float>(swapped(std::bit_cast<std::uint32_t>(value)));
        }
      }
      out.write(std::as_bytes(std::span<const float>(finished)));
    }
  }
  job.report(1, phase, fmt::format("{0} of {0} planes", dims[slow]));
}

}  // namespace footwall::formats::detail
