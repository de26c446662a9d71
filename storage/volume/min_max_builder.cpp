#include "storage/volume/min_max_builder.h"

#include <algorithm>
#include <limits>

#include "storage/base/error.h"

namespace footwall::volume {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::int64_t kStep = 8;

void merge(float* min, float* max, float* null, float other_min, float other_max, float other_null) {
  *min = std::min(*min, other_min);
  *max = std::max(*max, other_max);
  *null = std::max(*null, other_null);
}

// The first entry whose nine layers meet a box that starts at `lo`: the one before, if the layer is shared.
std::int64_t first_entry(std::int64_t lo) {
  return std::max<std::int64_t>(0, (lo + kStep - 1) / kStep - 1);
}

struct Extremes {
  float min = kInfinity;
  float max = -kInfinity;
  float null = 0;
};

// Min, max and has-null over several traces, sample by sample: vectorizes, and leaves an eighth of the work
// to columns.
struct Fold {
  std::vector<float> min, max;
  std::vector<std::uint32_t> null;
  // Of the samples from `first` to before `end`. -0 and +0 compare equal, so which one is met first depends
  // on the order of traces: +0 stands for both.
  Extremes over(std::int64_t first, std::int64_t end) const {
    Extremes all;
    for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(end); ++k) {
      merge(&all.min, &all.max, &all.null, min[k], max[k], static_cast<float>(null[k]));
    }
    return {all.min + 0.0F, all.max + 0.0F, all.null};
  }
  void clear(std::size_t samples) {
    min.assign(samples, kInfinity);
    max.assign(samples, -kInfinity);
    null.assign(samples, 0);
  }
  void add(const float* __restrict trace) {
    float* __restrict least = min.data();
    float* __restrict most = max.data();
    std::uint32_t* __restrict mask = null.data();
    const std::size_t samples = min.size();
    for (std::size_t k = 0; k < samples; ++k) {
      const float v = trace[k];
      least[k] = v < least[k] ? v : least[k];  // false for NaN
      most[k] = v > most[k] ? v : most[k];
      mask[k] |= v == v ? 0U : 1U;
    }
  }
};

}  // namespace

survey::Index min_max_dims(const survey::Index& volume_dims, int level) {
  const std::int64_t step = kStep << level;
  survey::Index n;
  for (int axis = 0; axis < 3; ++axis)
    n[axis] = std::max<std::int64_t>(1, (volume_dims[axis] - 2 + step) / step);
  return n;
}

int min_max_levels(const survey::Index& volume_dims) {
  int levels = 1;
  while (min_max_dims(volume_dims, levels - 1) != survey::Index{1, 1, 1}) ++levels;
  return levels;
}

MinMaxRow empty_row(std::int64_t plane) {
  MinMaxRow row(static_cast<std::size_t>(3 * plane), 0.0F);
  std::fill_n(row.begin(), plane, kInfinity);
  std::fill_n(row.begin() + plane, plane, -kInfinity);
  return row;
}

void merge_row(MinMaxRow& into, const MinMaxRow& more) {
  const std::size_t plane = into.size() / 3;
  for (std::size_t n = 0; n < plane; ++n) {
    merge(&into[n], &into[plane + n], &into[2 * plane + n], more[n], more[plane + n], more[2 * plane + n]);
  }
}

MinMaxRow halved(const MinMaxRow& row, std::int64_t nb, std::int64_t nc) {
  const std::int64_t hb = (nb + 1) / 2;
  const std::int64_t hc = (nc + 1) / 2;
  const std::int64_t from_plane = nb * nc;
  const std::int64_t plane = hb * hc;
  MinMaxRow half = empty_row(plane);
  for (std::int64_t b = 0; b < nb; ++b) {
    for (std::int64_t c = 0; c < nc; ++c) {
      float* to = half.data() + (b / 2) * hc + c / 2;
      const float* from = row.data() + b * nc + c;
      merge(to, to + plane, to + 2 * plane, from[0], from[from_plane], from[2 * from_plane]);
    }
  }
  return half;
}

RowRange rows_touched_by(const survey::Box& box, const survey::Index& volume_dims) {
  const std::int64_t rows = min_max_dims(volume_dims, 0)[0];
  return {first_entry(box.lo[0]), std::min((box.hi[0] - 1) / kStep, rows - 1) + 1};
}

MinMaxBuilder::MinMaxBuilder(const survey::Index& volume_dims, std::int64_t first_inline)
    : volume_dims_(volume_dims), entries_(min_max_dims(volume_dims, 0)), first_(first_entry(first_inline)) {}

void MinMaxBuilder::add(const survey::Box& box, std::span<const float> values) {
  require(box.size(2) == volume_dims_[2], "min/max blocks span all samples");
  require(values.size() == static_cast<std::size_t>(box.count()), "min/max block size");
  const auto [first_a, end_a] = rows_touched_by(box, volume_dims_);
  require(first_a >= first_, "a box whose rows were not taken");
  const std::int64_t plane = entries_[1] * entries_[2];
  const std::int64_t first_b = first_entry(box.lo[1]);
  const std::int64_t last_b = std::min((box.hi[1] - 1) / kStep, entries_[1] - 1);
  const std::int64_t samples = volume_dims_[2];
  const std::int64_t n_b = last_b - first_b + 1;
  const std::int64_t n_c = entries_[2];
  const auto found_size = static_cast<std::size_t>((end_a - first_a) * n_b * n_c);
  std::vector<Extremes> found(found_size);  // [a][b][c]
  Extremes* next = found.data();
  Fold fold;
  for (std::int64_t a = first_a; a < end_a; ++a) {
    for (std::int64_t b = first_b; b <= last_b; ++b) {
      const std::int64_t i_end = std::min(box.hi[0], a * kStep + kStep + 1);
      const std::int64_t j_end = std::min(box.hi[1], b * kStep + kStep + 1);
      fold.clear(static_cast<std::size_t>(samples));
      for (std::int64_t i = std::max(box.lo[0], a * kStep); i < i_end; ++i) {
        for (std::int64_t j = std::max(box.lo[1], b * kStep); j < j_end; ++j) {
          fold.add(values.data() + ((i - box.lo[0]) * box.size(1) + (j - box.lo[1])) * samples);
        }
      }
      for (std::int64_t c = 0; c < n_c; ++c) {
        *next++ = fold.over(c * kStep, std::min(samples, c * kStep + kStep + 1));
      }
    }
  }

  const std::scoped_lock lock(mutex_);
  while (first_ + static_cast<std::int64_t>(rows_.size()) < end_a) rows_.push_back(empty_row(plane));
  const Extremes* from = found.data();
  for (std::int64_t a = first_a; a < end_a; ++a) {
    float* row = rows_[static_cast<std::size_t>(a - first_)].data() + first_b * n_c;
    for (std::int64_t n = 0; n < n_b * n_c; ++n, ++from) {
      merge(row + n, row + n + plane, row + n + 2 * plane, from->min, from->max, from->null);
    }
  }
}

std::vector<MinMaxRow> MinMaxBuilder::take_finished(std::int64_t next_inline) {
  const std::scoped_lock lock(mutex_);
  std::vector<MinMaxRow> finished;
  // Row a needs inline 8a + 8 too, unless the volume ends before.
  while (!rows_.empty() && (next_inline >= volume_dims_[0] || next_inline > first_ * kStep + kStep)) {
    finished.push_back(std::move(rows_.front()));
    rows_.erase(rows_.begin());
    ++first_;
  }
  return finished;
}

}  // namespace footwall::volume
