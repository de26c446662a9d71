#include "engine/extract/cache/row_tiles.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/extract/cache/row_tiles.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::extract::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// As many columns of a brick as fit into a vector: eight from AVX2 on.
using Columns = hn::CappedTag<std::int32_t, 8>;
using Vec = hn::Vec<Columns>;

void list_tiles(std::span<const std::int32_t> lo, std::span<const std::int32_t> hi, std::int32_t u0,
                std::vector<RowTile>& tiles) {
  constexpr std::size_t kSide = 8;
  const Columns columns;
  const hn::Rebind<std::uint8_t, Columns> bytes;
  const hn::Rebind<std::uint32_t, Columns> unsigned_columns;
  const std::size_t lanes = hn::Lanes(columns);
  const auto zero = hn::Zero(columns);
  const auto eight = hn::Set(columns, 8);
  const auto one = hn::Set(columns, 1);
  const auto full = hn::Set(columns, 0xFF);
  tiles.clear();
  // The eight columns of a brick; those without voxels have lo above hi.
  const auto take = [&](const std::int32_t* from, const std::int32_t* to, std::int32_t u) HWY_ATTR {
    auto least = hn::Set(columns, std::numeric_limits<std::int32_t>::max());
    auto most = hn::Set(columns, std::numeric_limits<std::int32_t>::min());
    for (std::size_t c = 0; c < kSide; c += lanes) {
      const Vec first = hn::LoadU(columns, from + c);
      const Vec last = hn::LoadU(columns, to + c);
      const auto none = hn::Gt(first, last);
      least = hn::Min(least, hn::IfThenElse(none, least, first));
      most = hn::Max(most, hn::IfThenElse(none, most, last));
    }
    const std::int32_t lowest = hn::GetLane(hn::MinOfLanes(columns, least));
    const std::int32_t highest = hn::GetLane(hn::MaxOfLanes(columns, most));
    if (lowest > highest) return;
    for (std::int32_t w = lowest >> 3; w <= highest >> 3; ++w) {
      const auto base = hn::Set(columns, w * 8);
      std::uint64_t bits = 0;
      for (std::size_t c = 0; c < kSide; c += lanes) {
        const auto begin = hn::Sub(hn::LoadU(columns, from + c), base);
        const auto end = hn::Add(hn::Sub(hn::LoadU(columns, to + c), base), one);
        const auto below_begin = hn::Min(hn::Max(begin, zero), eight);
        const auto below_end = hn::Min(hn::Max(end, zero), eight);
        const auto mask = hn::And(hn::Shl(full, below_begin), hn::Sub(hn::Shl(one, below_end), one));
        std::array<std::uint8_t, HWY_MAX_BYTES> narrow{};
        hn::StoreU(hn::TruncateTo(bytes, hn::BitCast(unsigned_columns, mask)), bytes, narrow.data());
        std::uint64_t part = 0;
        std::memcpy(&part, narrow.data(), sizeof part);
        bits |= part << (8 * c);
      }
      if (bits != 0) tiles.push_back({u, w, bits});
    }
  };
  const std::size_t count = lo.size();
  for (std::size_t n = 0; n < count;) {
    const std::int32_t u = u0 + static_cast<std::int32_t>(n);
    const auto in_brick = static_cast<std::size_t>(u & 7);
    const std::size_t here = std::min(count - n, kSide - in_brick);
    if (here == kSide) {
      take(lo.data() + n, hi.data() + n, u >> 3);
    } else {
      std::array<std::int32_t, kSide> first;
      std::array<std::int32_t, kSide> last;
      first.fill(1);
      last.fill(0);
      std::copy_n(lo.data() + n, here, first.data() + in_brick);
      std::copy_n(hi.data() + n, here, last.data() + in_brick);
      take(first.data(), last.data(), u >> 3);
    }
    n += here;
  }
}

}  // namespace footwall::extract::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::extract {

HWY_EXPORT(list_tiles);

void list_tiles(std::span<const std::int32_t> lo, std::span<const std::int32_t> hi, std::int32_t u0,
                std::vector<RowTile>& tiles) {
  HWY_DYNAMIC_DISPATCH(list_tiles)(lo, hi, u0, tiles);
}

}  // namespace footwall::extract
#endif
