#include "engine/isosurface/visible/paper/workload.h"

#include <algorithm>

namespace footwall::isosurface {

std::int64_t Workload::of(const Field& field, const survey::Box& cells, float isovalue,
                          const survey::Index& block) {
  if (cells.empty()) return 0;
  constexpr std::uint8_t kBelow = 1;
  constexpr std::uint8_t kAbove = 2;
  const std::int64_t rows = cells.size(1) + 1;
  const auto size = static_cast<std::size_t>(cells.size(2) + 1);
  signs_.resize(static_cast<std::size_t>((cells.size(0) + 1) * rows) * size);
  std::uint8_t* sign = signs_.data();
  for (std::int64_t i = cells.lo[0]; i <= cells.hi[0]; ++i) {
    for (std::int64_t j = cells.lo[1]; j <= cells.hi[1]; ++j, sign += size) {
      const float* const row = field.values.data() +
                               ((i - field.origin[0]) * field.size[1] + j - field.origin[1]) * field.size[2] +
                               cells.lo[2] - field.origin[2];
      for (std::size_t k = 0; k < size; ++k) {
        sign[k] =
            static_cast<std::uint8_t>((row[k] < isovalue ? kBelow : 0) | (row[k] >= isovalue ? kAbove : 0));
      }
    }
  }
  met_.resize(size);
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < cells.size(0); i += block[0]) {
    for (std::int64_t j = 0; j < cells.size(1); j += block[1]) {
      std::fill(met_.begin(), met_.end(), std::uint8_t{0});
      for (std::int64_t p = i; p <= std::min(i + block[0], cells.size(0)); ++p) {
        for (std::int64_t r = j; r <= std::min(j + block[1], cells.size(1)); ++r) {
          const std::uint8_t* const of_row = signs_.data() + static_cast<std::size_t>(p * rows + r) * size;
          for (std::size_t k = 0; k < size; ++k) met_[k] |= of_row[k];
        }
      }
      for (std::int64_t k = 0; k < cells.size(2); k += block[2]) {
        const auto begin = met_.begin() + k;
        const auto end = met_.begin() + std::min(k + block[2], cells.size(2)) + 1;
        std::uint8_t all = 0;
        for (auto at = begin; at != end; ++at) all |= *at;
        count += all == (kBelow | kAbove) ? 1 : 0;
      }
    }
  }
  return count;
}

}  // namespace footwall::isosurface
