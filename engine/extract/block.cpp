#include "engine/extract/block.h"

#include <sys/mman.h>

#include <limits>
#include <new>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kFilledPerLook = std::size_t{1} << 21;  // values

}  // namespace

Block::Block(const survey::Box& own, const survey::Index& dims, const JobContext& job) : own_(own) {
  if (own.empty()) return;
  const survey::Box around{{own.lo[0] - 1, own.lo[1] - 1, own.lo[2]},
                           {own.hi[0] + 1, own.hi[1] + 1, own.hi[2]}};
  wanted_ = survey::intersection(around, {{0, 0, 0}, dims});
  corner_ = around.lo;
  strides_ = {around.size(1) * around.size(2), around.size(2), 1};
  const auto count = static_cast<std::size_t>(around.count());
  // A small block does not fill a huge page, and a rank may have many of them.
  const bool large = count * sizeof(float) >= kHugePage;
  const std::size_t unit = large ? kHugePage : kCacheLine;
  const std::size_t bytes = (count * sizeof(float) + unit - 1) / unit * unit;
  values_.reset(static_cast<float*>(std::aligned_alloc(unit, bytes)));
  if (!values_) throw std::bad_alloc();
  // Only advice: refused, it is slower and nothing else.
  if (large) madvise(values_.get(), bytes, MADV_HUGEPAGE);
  for (std::size_t from = 0; from < count; from += kFilledPerLook) {
    job.check();
    std::fill_n(values_.get() + from, std::min(kFilledPerLook, count - from),
                std::numeric_limits<float>::quiet_NaN());
  }
}

void Block::put(const survey::Box& part, std::span<const float> values) {
  if (part.empty()) return;
  require(
      survey::intersection(part, wanted_) == part && static_cast<std::int64_t>(values.size()) == part.count(),
      "values of a part of the block");
  const std::int64_t samples = part.size(2);
  const float* from = values.data();
  for (std::int64_t i = part.lo[0]; i < part.hi[0]; ++i) {
    for (std::int64_t j = part.lo[1]; j < part.hi[1]; ++j, from += samples) {
      std::copy_n(from, samples, values_.get() + offset({i, j, part.lo[2]}));
    }
  }
}

}  // namespace footwall::extract
