// The hot loop, compiled once for each instruction set: tables of the edges' bounds, then row after row.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/voxelize/detail/setup.h"
#include "engine/voxelize/rows.h"

namespace footwall::voxelize::detail {

// A bound from below and one from above for each position along an axis, with room for a vector more behind
// them, which the loops touch and do not use.
struct Bounds {
  static constexpr std::size_t kSlack = 64;
  std::vector<std::int32_t> lo;
  std::vector<std::int32_t> hi;
  void make_room(std::int64_t count);
};

struct RowBuffers {
  Bounds u_of_v;   // the columns of each row
  Bounds w_of_v;   // what a row says of w
  Bounds w_of_u;   // what a column says of w
  Bounds columns;  // the spans of the row at hand
};

// Emits all rows; setup.box must not be empty.
void emit_rows(const Setup& setup, RowBuffers& buffers, RowSink& sink);

// The instruction set that emit_rows now runs on, in Highway's words.
const char* target_in_use();

}  // namespace footwall::voxelize::detail
