#include "engine/extract/discontinuity_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::extract {
namespace {

constexpr std::int64_t kMostLines = 31;
constexpr std::int64_t kMostSamples = 255;
constexpr double kLargestSum = 0x1p41;  // of one sample; 255 of them fit into 64 bits

// Adding and taking away 1.5 * 2^52 leaves the nearest whole number, ties to even, for |x| < 2^51.
double rounded(double x) {
  constexpr double kShift = 0x1.8p52;
  return (x + kShift) - kShift;
}

}  // namespace

Window parse_window(std::string_view text) {
  const auto parts = text::split(text, 'x');
  std::array<std::int64_t, 3> sizes{};
  bool good = parts.size() == 3;
  for (std::size_t n = 0; good && n < 3; ++n) {
    const auto size = text::integer(parts[n]);
    good = size && *size >= 1 && *size % 2 == 1 && *size <= (n < 2 ? kMostLines : kMostSamples);
    if (good) sizes[n] = *size;
  }
  if (!good || sizes[0] * sizes[1] < 2) {
    throw Error(
        ErrorCode::kUsage, "'" + std::string(text) + "' is not a window",
        "give inlines x crosslines x samples as odd numbers, at most 31x31x255 and more than one trace, "
        "such as 3x3x9");
  }
  return {sizes[0], sizes[1], sizes[2]};
}

std::string text_of(const Window& window) {
  return std::to_string(window.inlines) + "x" + std::to_string(window.crosslines) + "x" +
         std::to_string(window.samples);
}

survey::Box needed_for(const survey::Box& box, const Window& window, const survey::Index& dims) {
  if (box.empty()) return {};
  const survey::Index half{window.inlines / 2, window.crosslines / 2, window.samples / 2};
  survey::Box around = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    around.lo[axis] -= half[axis];
    around.hi[axis] += half[axis];
  }
  return survey::intersection(around, {{0, 0, 0}, dims});
}

DiscontinuityVolume::DiscontinuityVolume(const Window& window, const survey::Index& dims, double max_abs)
    : window_(window), dims_(dims) {
  require(max_abs >= 0 && std::isfinite(max_abs), "a volume's largest magnitude");
  const auto traces = static_cast<double>(window.inlines * window.crosslines);
  scale_ = max_abs == 0 ? 0 : std::ldexp(1.0, 40) / (traces * traces * (max_abs * max_abs));
  fewest_ = std::min(4.0, traces);
}

void DiscontinuityVolume::compute(const survey::Box& box, std::span<const float> values,
                                  std::span<float> out) {
  const survey::Box around = needed_for(box, window_, dims_);
  require(static_cast<std::int64_t>(values.size()) == around.count() &&
              static_cast<std::int64_t>(out.size()) == box.count(),
          "values of the box and of what is needed for it");
  const auto samples = static_cast<std::size_t>(around.size(2));
  const std::int64_t half = window_.samples / 2;
  float* to = out.data();
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      // 1 Over the traces around, ascending (inline, crossline), all samples at once.
      sum_.assign(samples, 0);
      squares_.assign(samples, 0);
      traces_.assign(samples, 0);
      for (std::int64_t ii = std::max(i - window_.inlines / 2, around.lo[0]);
           ii < std::min(i + window_.inlines / 2 + 1, around.hi[0]); ++ii) {
        for (std::int64_t jj = std::max(j - window_.crosslines / 2, around.lo[1]);
             jj < std::min(j + window_.crosslines / 2 + 1, around.hi[1]); ++jj) {
          const float* trace =
              values.data() + ((ii - around.lo[0]) * around.size(1) + jj - around.lo[1]) * around.size(2);
          double* sum = sum_.data();
          double* squares = squares_.data();
          double* traces = traces_.data();
#pragma omp simd
          for (std::size_t k = 0; k < samples; ++k) {
            const bool good = std::abs(trace[k]) <= std::numeric_limits<float>::max();
            const double v = good ? static_cast<double>(trace[k]) : 0.0;
            sum[k] += v;
            squares[k] += v * v;
            traces[k] += good ? 1.0 : 0.0;
          }
        }
      }
      // 2 Each sample's num and den in the fixed point's units.
      num_.resize(samples);
      den_.resize(samples);
      double largest = 0;
      for (std::size_t k = 0; k < samples; ++k) {
        const bool enough = traces_[k] >= fewest_;
        const double num = enough ? rounded(sum_[k] * sum_[k] * scale_) : 0;
        const double den = enough ? rounded(traces_[k] * squares_[k] * scale_) : 0;
        largest = std::max(largest, den);
        num_[k] = static_cast<std::int64_t>(std::min(num, kLargestSum));
        den_[k] = static_cast<std::int64_t>(std::min(den, kLargestSum));
      }
      if (!(largest <= kLargestSum)) {
        throw Error(ErrorCode::kCorrupt, "a sample is larger than the volume's recorded largest magnitude",
                    "the volume file was altered; import it again");
      }
      // 3 Their sums over the vertical window, which slides down.
      const auto clamped = [&](std::int64_t k) {
        return static_cast<std::size_t>(std::clamp<std::int64_t>(k - around.lo[2], 0, around.size(2)));
      };
      std::int64_t num = 0;
      std::int64_t den = 0;
      std::size_t first = clamped(box.lo[2] - half);
      std::size_t last = first;  // summed: [first, last)
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
        for (const std::size_t end = clamped(k + half + 1); last < end; ++last) {
          num += num_[last];
          den += den_[last];
        }
        for (const std::size_t begin = clamped(k - half); first < begin; ++first) {
          num -= num_[first];
          den -= den_[first];
        }
        const double difference = static_cast<double>(std::max<std::int64_t>(den - num, 0));
        *to++ = den == 0 ? std::numeric_limits<float>::quiet_NaN()
                         : static_cast<float>(difference / static_cast<double>(den));
      }
    }
  }
}

}  // namespace footwall::extract
