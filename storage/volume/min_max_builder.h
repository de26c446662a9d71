// Builds level 0 of the min/max pyramid from blocks of a volume, keeping one layer of blocks only.
#pragma once
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "storage/volume/min_max.h"

namespace footwall::volume {

// One layer of a level: all entries (b,c) of one a, as three planes: min, max, has-null (0 or 1).
using MinMaxRow = std::vector<float>;
// The row that changes nothing when merged; `plane` = entries of a plane.
MinMaxRow empty_row(std::int64_t plane);
// The row that covers both.
void merge_row(MinMaxRow& into, const MinMaxRow& more);
// One row of the next level from one or two rows of a level with dims (.., nb, nc).
MinMaxRow halved(const MinMaxRow& row, std::int64_t nb, std::int64_t nc);

// Rows `first` to before `end` of level 0: those that the samples of a box touch.
struct RowRange {
  std::int64_t first = 0;
  std::int64_t end = 0;
};
RowRange rows_touched_by(const survey::Box& box, const survey::Index& volume_dims);

class MinMaxBuilder {
 public:
  // first_inline: no box begins before it; rows that only inlines before it touch are left out.
  explicit MinMaxBuilder(const survey::Index& volume_dims, std::int64_t first_inline = 0);
  // Samples of a box that spans all samples of its traces, [inline][crossline][sample], nulls NaN. Boxes may
  // come in any order and from several threads at once: the entries are the same to the bit (a zero is +0).
  void add(const survey::Box& box, std::span<const float> values);
  // The next rows that no inline from `next_inline` on can change, once each, in order; pass dims[0] at the
  // end. All boxes with inlines before `next_inline` must have been added.
  std::vector<MinMaxRow> take_finished(std::int64_t next_inline);

 private:
  survey::Index volume_dims_;
  survey::Index entries_;
  std::mutex mutex_;        // of what follows
  std::int64_t first_ = 0;  // the a of rows_[0]
  std::vector<MinMaxRow> rows_;
};

}  // namespace footwall::volume
