// Lanes are bands along a row and columns across rows, never the terms of a sum: every coefficient adds its
// terms in the same order on every instruction set. A basis vector is even (bands 0, 2, 4, 6) or odd about
// its middle, so that values t and 15 - t are added or subtracted first and 8 products are left of 16.
#include "engine/extract/lapped/transform.h"

#include <algorithm>

#include "storage/base/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/extract/lapped/transform.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#ifndef FOOTWALL_LAPPED_TRANSFORM_TABLES
#define FOOTWALL_LAPPED_TRANSFORM_TABLES
namespace footwall::extract::lapped {

struct Table {
  alignas(64) float weight[kBands][kBands];  // [value of the first half][band]
};

}  // namespace footwall::extract::lapped
#endif

HWY_BEFORE_NAMESPACE();
namespace footwall::extract::lapped::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kBands>;

// The 8 coefficients of taps[0, 16).
HWY_INLINE void along(const float* HWY_RESTRICT taps, const Table& table, float* HWY_RESTRICT out) {
  const Lanes d;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN float folded[2 * kBands];  // sum, difference, sum, difference ...
  for (std::size_t t = 0; t < kBands; t += lanes) {
    const auto first = hn::LoadU(d, taps + t);
    const auto second = hn::Reverse(d, hn::LoadU(d, taps + kTaps - t - lanes));
    hn::StoreInterleaved2(hn::Add(first, second), hn::Sub(first, second), d, folded + 2 * t);
  }
  for (std::size_t k = 0; k < kBands; k += lanes) {
    auto sum = hn::Zero(d);
    for (std::size_t t = 0; t < kBands; ++t) {
#if HWY_TARGET == HWY_SCALAR
      const auto value = hn::Set(d, folded[2 * t + k % 2]);
#else
      const hn::Repartition<std::uint64_t, Lanes> pair;
      std::uint64_t both = 0;
      hwy::CopyBytes<sizeof both>(folded + 2 * t, &both);
      const auto value = hn::BitCast(d, hn::Set(pair, both));
#endif
      const auto term = hn::Mul(value, hn::Load(d, table.weight[t] + k));
      sum = t == 0 ? term : hn::Add(sum, term);
    }
    hn::StoreU(sum, d, out + k);
  }
}

void forward_line(const float* HWY_RESTRICT values, std::size_t blocks, const Table& table,
                  float* HWY_RESTRICT out) {
  const std::size_t n = blocks * kBands;
  HWY_ALIGN float ends[kTaps];
  const auto at = [&](std::size_t t) {  // t is 4 more than the place
    if (t < kReach) return values[kReach - 1 - t];
    t -= kReach;
    return t < n ? values[t] : values[2 * n - 1 - t];
  };
  for (std::size_t t = 0; t < kTaps; ++t) ends[t] = at(t);
  along(ends, table, out);
  for (std::size_t b = 1; b + 1 < blocks; ++b) along(values + b * kBands - kReach, table, out + b * kBands);
  if (blocks == 1) return;
  for (std::size_t t = 0; t < kTaps; ++t) ends[t] = at(n - kBands + t);
  along(ends, table, out + n - kBands);
}

void rows_of_tiles(const Tile* tiles, std::size_t count, const float* HWY_RESTRICT values, const Table& table,
                   float* HWY_RESTRICT out) {
  HWY_ALIGN float taps[kTaps];
  for (std::size_t n = 0; n < count; ++n) {
    const float* own = values + n * kSquare;
    const float* left = tiles[n].left == Tile::kNone ? nullptr : values + tiles[n].left * kSquare;
    const float* right = tiles[n].right == Tile::kNone ? nullptr : values + tiles[n].right * kSquare;
    for (std::size_t row = 0; row < kSquare; row += kBands) {
      for (std::size_t t = 0; t < kReach; ++t) {
        taps[t] = left != nullptr ? left[row + kReach + t] : own[row + kReach - 1 - t];
        taps[kReach + kBands + t] = right != nullptr ? right[row + t] : own[row + kBands - 1 - t];
      }
      hwy::CopyBytes<kBands * sizeof(float)>(own + row, taps + kReach);
      along(taps, table, out + n * kSquare + row);
    }
  }
}

void columns_of_tiles(const Tile* tiles, std::size_t count, const float* HWY_RESTRICT values,
                      const Table& table, float* HWY_RESTRICT out) {
  const Lanes d;
  for (std::size_t n = 0; n < count; ++n) {
    const float* rows[kTaps];
    const float* own = values + n * kSquare;
    const float* above = tiles[n].above == Tile::kNone ? nullptr : values + tiles[n].above * kSquare;
    const float* below = tiles[n].below == Tile::kNone ? nullptr : values + tiles[n].below * kSquare;
    for (std::size_t t = 0; t < kReach; ++t) {
      rows[t] = above != nullptr ? above + (kReach + t) * kBands : own + (kReach - 1 - t) * kBands;
      rows[kReach + kBands + t] = below != nullptr ? below + t * kBands : own + (kBands - 1 - t) * kBands;
    }
    for (std::size_t t = 0; t < kBands; ++t) rows[kReach + t] = own + t * kBands;
    float* tile = out + n * kSquare;
    for (std::size_t column = 0; column < kBands; column += hn::Lanes(d)) {
      using Vector = hn::Vec<Lanes>;
      Vector even[kBands / 2];
      Vector odd[kBands / 2];
      for (std::size_t t = 0; t < kBands; ++t) {
        const auto first = hn::LoadU(d, rows[t] + column);
        const auto second = hn::LoadU(d, rows[kTaps - 1 - t] + column);
        const auto sum = hn::Add(first, second);
        const auto difference = hn::Sub(first, second);
        for (std::size_t k = 0; k < kBands / 2; ++k) {
          const auto a = hn::Mul(sum, hn::Set(d, table.weight[t][2 * k]));
          const auto b = hn::Mul(difference, hn::Set(d, table.weight[t][2 * k + 1]));
          even[k] = t == 0 ? a : hn::Add(even[k], a);
          odd[k] = t == 0 ? b : hn::Add(odd[k], b);
        }
      }
      for (std::size_t k = 0; k < kBands / 2; ++k) {
        hn::StoreU(even[k], d, tile + 2 * k * kBands + column);
        hn::StoreU(odd[k], d, tile + (2 * k + 1) * kBands + column);
      }
    }
  }
}

}  // namespace footwall::extract::lapped::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::extract::lapped {

HWY_EXPORT(forward_line);
HWY_EXPORT(rows_of_tiles);
HWY_EXPORT(columns_of_tiles);

namespace {

struct Tables {
  Table folded;                 // what the forward transform multiplies
  float weight[kTaps][kBands];  // the basis
};

Tables tables_of(Angles angles) {
  Tables tables{};
  for (std::size_t t = 0; t < kTaps; ++t) {
    for (std::size_t k = 0; k < kBands; ++k) {
      const auto weight = static_cast<float>(basis(angles)[t][k]);
      if (t < kBands) tables.folded.weight[t][k] = weight;
      tables.weight[t][k] = weight;
    }
  }
  return tables;
}

const Tables& tables(Angles angles) {
  static const Tables standard = tables_of(Angles::kStandard);
  static const Tables tuned = tables_of(Angles::kTuned);
  return angles == Angles::kTuned ? tuned : standard;
}

// The 8 values of a block, stride apart, from its own coefficients and those of its neighbours (null: the
// block itself, mirrored).
void restore(const float* before, const float* own, const float* after, const Tables& table,
             std::size_t stride, float* values) {
  for (std::size_t i = 0; i < kBands; ++i) {
    const bool first = i < kReach;
    const float* other = first ? before : after;
    // Where this value stands among the taps of the other block; with none, its image among the own taps.
    std::size_t tap = first ? kReach + kBands + i : i - kReach;
    if (other == nullptr) tap = first ? kReach - 1 - i : kTaps + kReach - 1 - i;
    if (other == nullptr) other = own;
    float sum = 0;
    for (std::size_t k = 0; k < kBands; ++k) sum += table.weight[kReach + i][k] * own[k * stride];
    for (std::size_t k = 0; k < kBands; ++k) sum += table.weight[tap][k] * other[k * stride];
    values[i * stride] = sum;
  }
}

const float* tile_at(std::span<const float> values, std::uint32_t tile) {
  return tile == Tile::kNone ? nullptr : values.data() + tile * kSquare;
}

}  // namespace

void forward(std::span<const float> values, Angles angles, std::span<float> coefficients) {
  require(!values.empty() && values.size() % kBands == 0 && values.size() == coefficients.size(),
          "whole blocks of values");
  HWY_DYNAMIC_DISPATCH(forward_line)
  (values.data(), values.size() / kBands, tables(angles).folded, coefficients.data());
}

void inverse(std::span<const float> coefficients, Angles angles, std::span<float> values) {
  require(!values.empty() && values.size() % kBands == 0 && values.size() == coefficients.size(),
          "whole blocks of coefficients");
  const float* own = coefficients.data();
  const float* const last = own + coefficients.size() - kBands;
  const float* before = nullptr;
  for (float* out = values.data(); own <= last; own += kBands, out += kBands) {
    restore(before, own, own == last ? nullptr : own + kBands, tables(angles), 1, out);
    before = own;
  }
}

void forward(std::span<const Tile> tiles, std::span<const float> values, Angles across, Angles down,
             std::span<float> work, std::span<float> coefficients) {
  require(values.size() == tiles.size() * kSquare && work.size() == values.size() &&
              coefficients.size() == values.size(),
          "64 values of every tile");
  HWY_DYNAMIC_DISPATCH(rows_of_tiles)
  (tiles.data(), tiles.size(), values.data(), tables(across).folded, work.data());
  HWY_DYNAMIC_DISPATCH(columns_of_tiles)
  (tiles.data(), tiles.size(), work.data(), tables(down).folded, coefficients.data());
}

void inverse(std::span<const Tile> tiles, std::span<const float> coefficients, Angles across, Angles down,
             std::span<float> work, std::span<float> values) {
  require(values.size() == tiles.size() * kSquare && work.size() == values.size() &&
              coefficients.size() == values.size(),
          "64 coefficients of every tile");
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    const float* above = tile_at(coefficients, tiles[n].above);
    const float* below = tile_at(coefficients, tiles[n].below);
    for (std::size_t column = 0; column < kBands; ++column) {
      restore(above == nullptr ? nullptr : above + column, coefficients.data() + n * kSquare + column,
              below == nullptr ? nullptr : below + column, tables(down), kBands,
              work.data() + n * kSquare + column);
    }
  }
  const std::span<const float> half(work);
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    const float* left = tile_at(half, tiles[n].left);
    const float* right = tile_at(half, tiles[n].right);
    for (std::size_t row = 0; row < kSquare; row += kBands) {
      restore(left == nullptr ? nullptr : left + row, half.data() + n * kSquare + row,
              right == nullptr ? nullptr : right + row, tables(across), 1, values.data() + n * kSquare + row);
    }
  }
}

}  // namespace footwall::extract::lapped
#endif
