#include "engine/extract/lapped/raster.h"

#include <algorithm>

namespace footwall::extract::lapped {
namespace {

constexpr std::int64_t kSide = kBands;

// cos(pi / 8), cos(3 pi / 8) over sqrt(2), and roots: each the float nearest.
constexpr float kHalfRoot = 0.7071067811865476F;
constexpr float kSixthRoot = 0.4082482904638630F;
constexpr float kThird = 0.3333333333333333F;
constexpr float kWide = 0.6532814824381883F;
constexpr float kNarrow = 0.2705980500730985F;

// v[0, n) of a column to its mean and the further coefficients, in place; and back.
void along_column(float* v, std::int32_t n) {
  if (n == 2) {
    const float mean = 0.5F * (v[0] + v[1]);
    v[1] = kHalfRoot * (v[0] - v[1]);
    v[0] = mean;
  } else if (n == 3) {
    const float outer = v[0] + v[2];
    const float slope = kHalfRoot * (v[0] - v[2]);
    const float bend = kSixthRoot * (outer - 2 * v[1]);
    v[0] = kThird * (outer + v[1]);
    v[1] = slope;
    v[2] = bend;
  } else if (n == 4) {
    const float outer = v[0] + v[3];
    const float inner = v[1] + v[2];
    const float far = v[0] - v[3];
    const float near = v[1] - v[2];
    v[0] = 0.25F * (outer + inner);
    v[1] = kWide * far + kNarrow * near;
    v[2] = 0.5F * (outer - inner);
    v[3] = kNarrow * far - kWide * near;
  }
}

void back_along_column(float* v, std::int32_t n) {
  if (n == 2) {
    const float half = kHalfRoot * v[1];
    v[1] = v[0] - half;
    v[0] = v[0] + half;
  } else if (n == 3) {
    const float slope = kHalfRoot * v[1];
    const float bend = kSixthRoot * v[2];
    const float mean = v[0];
    v[0] = mean + bend + slope;
    v[1] = mean - 2 * bend;
    v[2] = mean + bend - slope;
  } else if (n == 4) {
    const float half = 0.5F * v[2];
    const float outer = v[0] + half;
    const float inner = v[0] - half;
    const float far = kWide * v[1] + kNarrow * v[3];
    const float near = kNarrow * v[1] - kWide * v[3];
    v[0] = outer + far;
    v[1] = inner + near;
    v[2] = inner - near;
    v[3] = outer - far;
  }
}

// One row of a run of tiles beside each other: value c stands at tile (first + c / 8).
class RunRow {
 public:
  RunRow(const std::uint8_t* known, std::size_t first, std::size_t tiles, std::size_t row, float* picture)
      : known_(known + first * kBands + row),
        values_(picture + first * kSquare + row * kBands),
        columns_(tiles * kBands) {}
  std::size_t columns() const { return columns_; }
  bool known(std::size_t c) const { return (known_[c / kBands * kBands] >> (c % kBands) & 1) != 0; }
  float& at(std::size_t c) { return values_[c / kBands * kSquare + c % kBands]; }
  bool whole() const {
    for (std::size_t c = 0; c < columns_; c += kBands) {
      if (known_[c] != 0xff) return false;
    }
    return true;
  }

  // Lines between the values that are there, the outer ones repeated. False where there are none.
  bool fill() {
    if (whole()) return true;
    std::size_t last = columns_;  // the last known
    for (std::size_t c = 0; c < columns_; ++c) {
      if (!known(c)) continue;
      if (last == columns_) {
        for (std::size_t gap = 0; gap < c; ++gap) at(gap) = at(c);
      } else if (c > last + 1) {
        const float step = (at(c) - at(last)) / static_cast<float>(c - last);
        for (std::size_t gap = last + 1; gap < c; ++gap) {
          at(gap) = at(last) + step * static_cast<float>(gap - last);
        }
      }
      last = c;
    }
    if (last == columns_) return false;
    for (std::size_t gap = last + 1; gap < columns_; ++gap) at(gap) = at(last);
    return true;
  }

  void copy(RunRow& other) {
    for (std::size_t c = 0; c < columns_; ++c) at(c) = other.at(c);
  }

 private:
  const std::uint8_t* known_;
  float* values_;
  std::size_t columns_;
};

void fill(std::span<const Tile> tiles, const std::uint8_t* known, float* picture) {
  for (std::size_t first = 0; first < tiles.size();) {
    std::size_t end = first + 1;
    while (end < tiles.size() && tiles[end].left != Tile::kNone) ++end;
    std::array<bool, kBands> filled{};
    for (std::size_t row = 0; row < kBands; ++row) {
      filled[row] = RunRow(known, first, end - first, row, picture).fill();
    }
    // Rows without a value take those of the nearest one with, the former where two are as near.
    for (std::size_t row = 0; row < kBands; ++row) {
      if (filled[row]) continue;
      for (std::size_t distance = 1; distance < kBands; ++distance) {
        std::size_t from = kBands;
        if (distance <= row && filled[row - distance]) {
          from = row - distance;
        } else if (row + distance < kBands && filled[row + distance]) {
          from = row + distance;
        }
        if (from == kBands) continue;
        RunRow source(known, first, end - first, from, picture);
        RunRow(known, first, end - first, row, picture).copy(source);
        break;
      }
    }
    first = end;
  }
}

}  // namespace

bool Raster::lay_out(const Columns& columns) {
  tiles_.clear();
  known_.clear();
  places_.clear();
  details_ = {};
  for (const std::int32_t length : columns.lengths) {
    if (length > kLongestColumn) return false;
    for (std::int32_t n = 1; n < length; ++n) ++details_[static_cast<std::size_t>(n) - 1];
  }
  if (columns.rows.empty()) return true;
  std::int64_t u_first = columns.rows.front().u;
  std::int64_t u_last = u_first;
  for (const ColumnRow& row : columns.rows) {
    u_first = std::min(u_first, row.u);
    u_last = std::max(u_last, row.u + static_cast<std::int64_t>(row.count));
  }
  const auto wide = static_cast<std::size_t>((u_last - u_first) / kSide + 1);
  const std::int64_t v_first = columns.rows.front().v;
  above_.assign(wide, Tile::kNone);
  std::int64_t row_above = -2;  // the row of tiles that above_ tells of
  for (std::size_t begin = 0; begin < columns.rows.size();) {
    const std::int64_t tile_row = (columns.rows[begin].v - v_first) / kSide;
    std::size_t end = begin;
    here_.assign(wide, Tile::kNone);
    for (; end < columns.rows.size() && (columns.rows[end].v - v_first) / kSide == tile_row; ++end) {
      const ColumnRow& row = columns.rows[end];
      const auto left = static_cast<std::size_t>(row.u - u_first);
      for (std::size_t n = 0; n < row.count; ++n) {
        if (columns.lengths[row.first + n] > 0) here_[(left + n) / kBands] = 0;
      }
    }
    if (row_above + 1 != tile_row) above_.assign(wide, Tile::kNone);
    std::uint32_t left = Tile::kNone;
    for (std::size_t n = 0; n < wide; ++n) {
      if (here_[n] == Tile::kNone) {
        left = Tile::kNone;
        continue;
      }
      const auto index = static_cast<std::uint32_t>(tiles_.size());
      here_[n] = index;
      tiles_.push_back({left, Tile::kNone, above_[n], Tile::kNone});
      if (left != Tile::kNone) tiles_[left].right = index;
      if (above_[n] != Tile::kNone) tiles_[above_[n]].below = index;
      left = index;
    }
    known_.resize(tiles_.size() * kBands, 0);
    for (; begin < end; ++begin) {
      const ColumnRow& row = columns.rows[begin];
      const auto left_column = static_cast<std::size_t>(row.u - u_first);
      const auto tile_line = static_cast<std::size_t>((row.v - v_first) % kSide);
      for (std::size_t n = 0; n < row.count; ++n) {
        if (columns.lengths[row.first + n] == 0) continue;
        const std::size_t column = left_column + n;
        const std::size_t line = here_[column / kBands] * kBands + tile_line;
        known_[line] = static_cast<std::uint8_t>(known_[line] | 1U << (column % kBands));
        places_.push_back(static_cast<std::uint32_t>(line * kBands + column % kBands));
      }
    }
    std::swap(above_, here_);
    row_above = tile_row;
  }
  return true;
}

void Raster::spread(const Columns& columns, std::span<const float> values, std::vector<float>& picture,
                    Details& details) const {
  picture.resize(tiles_.size() * kSquare);
  std::array<float*, kDetails> next{};
  for (std::size_t n = 0; n < kDetails; ++n) {
    details[n].resize(details_[n]);
    next[n] = details[n].data();
  }
  const std::uint32_t* place = places_.data();
  const float* value = values.data();
  for (const std::int32_t length : columns.lengths) {
    if (length == 0) continue;
    if (length == 1) {
      picture[*place++] = *value++;
      continue;
    }
    std::array<float, kLongestColumn> column{};
    std::copy_n(value, length, column.begin());
    value += length;
    along_column(column.data(), length);
    picture[*place++] = column[0];
    for (std::size_t n = 1; n < static_cast<std::size_t>(length); ++n) *next[n - 1]++ = column[n];
  }
  fill(tiles_, known_.data(), picture.data());
}

void Raster::collect(const Columns& columns, std::span<const float> picture, const Details& details,
                     std::span<float> values) const {
  std::array<const float*, kDetails> next{};
  for (std::size_t n = 0; n < kDetails; ++n) next[n] = details[n].data();
  const std::uint32_t* place = places_.data();
  float* value = values.data();
  for (const std::int32_t length : columns.lengths) {
    if (length == 0) continue;
    std::array<float, kLongestColumn> column{picture[*place++]};
    for (std::size_t n = 1; n < static_cast<std::size_t>(length); ++n) column[n] = *next[n - 1]++;
    back_along_column(column.data(), length);
    value = std::copy_n(column.data(), length, value);
  }
}

}  // namespace footwall::extract::lapped
