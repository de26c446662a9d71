#include "engine/extract/replay/trace_bits.h"

#include <algorithm>

namespace footwall::extract {

void TraceBits::touch(const survey::Box& box) {
  if (touched_.empty()) {
    touched_ = {{box.lo[0], box.lo[1], 0}, {box.hi[0], box.hi[1], dims_[2]}};
    return;
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    touched_.lo[axis] = std::min(touched_.lo[axis], box.lo[axis]);
    touched_.hi[axis] = std::max(touched_.hi[axis], box.hi[axis]);
  }
}

void TraceBits::fill(std::int64_t i, std::int64_t j, std::int64_t first, std::int64_t last) {
  std::uint64_t* const bits = trace(i, j);
  for (std::int64_t k = first; k <= last;) {
    const std::int64_t word = k / 64;
    const std::int64_t end = std::min(last, word * 64 + 63);
    bits[word] |= (~std::uint64_t{0} >> (63 - (end - k))) << (k % 64);
    k = end + 1;
  }
}

void TraceBits::row(const voxelize::Row& row) {
  survey::Index at{};
  at[static_cast<std::size_t>(row.v_axis)] = row.v;
  const auto u_axis = static_cast<std::size_t>(row.u_axis);
  const auto w_axis = static_cast<std::size_t>(row.w_axis);
  std::int64_t least = dims_[w_axis];
  std::int64_t most = -1;
  for (std::size_t n = 0; n < row.lo.size(); ++n) {
    const std::int64_t lo = row.lo[n];
    const std::int64_t hi = row.hi[n];
    if (hi < lo) continue;
    at[u_axis] = row.u0 + static_cast<std::int64_t>(n);
    if (w_axis == 2) {
      fill(at[0], at[1], lo, hi);
    } else {
      for (std::int64_t w = lo; w <= hi; ++w) {
        at[w_axis] = w;
        trace(at[0], at[1])[at[2] / 64] |= std::uint64_t{1} << (at[2] % 64);
      }
    }
    least = std::min(least, lo);
    most = std::max(most, hi);
  }
  if (most < least) return;
  survey::Box box;
  const auto v_axis = static_cast<std::size_t>(row.v_axis);
  box.lo[v_axis] = row.v;
  box.hi[v_axis] = row.v + 1;
  box.lo[u_axis] = row.u0;
  box.hi[u_axis] = row.u0 + static_cast<std::int64_t>(row.lo.size());
  box.lo[w_axis] = least;
  box.hi[w_axis] = most + 1;
  touch(box);
}

void TraceBits::add(const survey::Box& box) {
  const survey::Box inside = survey::intersection(box, {{0, 0, 0}, dims_});
  if (inside.empty()) return;
  for (std::int64_t i = inside.lo[0]; i < inside.hi[0]; ++i) {
    for (std::int64_t j = inside.lo[1]; j < inside.hi[1]; ++j) fill(i, j, inside.lo[2], inside.hi[2] - 1);
  }
  touch(inside);
}

void TraceBits::copy(const TraceBits& other, const survey::Box& traces) {
  if (traces.empty()) return;
  for (std::int64_t i = traces.lo[0]; i < traces.hi[0]; ++i) {
    const auto length = static_cast<std::size_t>(traces.size(1)) * words_;
    std::copy_n(other.trace(i, traces.lo[1]), length, trace(i, traces.lo[1]));
  }
  touch(traces);
}

void TraceBits::clear() {
  for (std::int64_t i = touched_.lo[0]; i < touched_.hi[0]; ++i) {
    std::fill(trace(i, touched_.lo[1]),
              trace(i, touched_.lo[1]) + touched_.size(1) * static_cast<std::int64_t>(words_), 0);
  }
  touched_ = {};
}

void TraceBits::spread(int axis, std::int64_t before, std::int64_t after) {
  if (touched_.empty()) return;
  const auto a = static_cast<std::size_t>(axis);
  survey::Box result = touched_;
  result.lo[a] = std::max<std::int64_t>(0, touched_.lo[a] - before);
  result.hi[a] = std::min(dims_[a], touched_.hi[a] + after);
  const survey::Box from = touched_;
  const std::int64_t other_lo = from.lo[1 - a];
  const std::int64_t lines = from.size(1 - axis);
  // A copy of the lines along the axis, one after the other, so that none is read after it was changed.
  std::vector<std::uint64_t> line(static_cast<std::size_t>(from.size(axis)) * words_);
  for (std::int64_t n = 0; n < lines; ++n) {
    const auto at = [&](std::int64_t x) {
      return axis == 0 ? trace(x, other_lo + n) : trace(other_lo + n, x);
    };
    for (std::int64_t x = from.lo[a]; x < from.hi[a]; ++x) {
      std::copy_n(at(x), words_, line.data() + static_cast<std::size_t>(x - from.lo[a]) * words_);
    }
    for (std::int64_t x = from.lo[a]; x < from.hi[a]; ++x) {
      const std::uint64_t* const source = line.data() + static_cast<std::size_t>(x - from.lo[a]) * words_;
      for (std::int64_t to = std::max(result.lo[a], x - before); to <= std::min(result.hi[a] - 1, x + after);
           ++to) {
        std::uint64_t* const target = at(to);
        for (std::size_t w = 0; w < words_; ++w) target[w] |= source[w];
      }
    }
  }
  touched_ = result;
}

void TraceBits::grow(std::int64_t reach) {
  if (reach == 0) return;
  spread(0, reach, reach);
  spread(1, reach, reach);
}

void TraceBits::add_blocks(std::int64_t side) {
  if (side <= 1 || touched_.empty()) return;
  const std::int64_t before = side / 2;
  const std::int64_t after = side - 1 - before;
  // Along the samples, one step at a time: bits shift up or down by one through the words of a trace.
  const std::uint64_t last =
      dims_[2] % 64 == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << (dims_[2] % 64)) - 1;
  for (std::int64_t i = touched_.lo[0]; i < touched_.hi[0]; ++i) {
    for (std::int64_t j = touched_.lo[1]; j < touched_.hi[1]; ++j) {
      std::uint64_t* const bits = trace(i, j);
      for (std::int64_t step = 0; step < before; ++step) {
        for (std::size_t w = 0; w < words_; ++w) {
          bits[w] |= bits[w] >> 1 | (w + 1 < words_ ? bits[w + 1] << 63 : 0);
        }
      }
      for (std::int64_t step = 0; step < after; ++step) {
        for (std::size_t w = words_; w-- > 0;) bits[w] |= bits[w] << 1 | (w > 0 ? bits[w - 1] >> 63 : 0);
      }
      bits[words_ - 1] &= last;
    }
  }
  spread(0, before, after);
  spread(1, before, after);
}

}  // namespace footwall::extract
