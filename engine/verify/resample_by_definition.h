// Resampling as it is defined: every new sample a sum over its whole neighbourhood of old ones, nothing
// shared, nothing streamed. For fields without nulls.
#pragma once
#include <functional>

#include "storage/survey/box.h"

namespace footwall::verify {

// Old samples by index; the three positions, in old indices, of the new one; the spacing of the new grid in
// old ones along each axis; counts of old ones.
double resampled_sample(const std::function<double(std::int64_t, std::int64_t, std::int64_t)>& old,
                        const survey::Index& counts, const std::array<double, 3>& at,
                        const std::array<double, 3>& spacing);

}  // namespace footwall::verify
