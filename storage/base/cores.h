// The processors that this process may use.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

namespace footwall {

// The affinity mask: bit n % 64 of word n / 64 is processor n. At least one bit is set.
std::vector<std::uint64_t> affinity_mask();
// What the control group's CPU quota comes to, rounded up; nothing where there is none.
std::optional<int> quota_cores();
// Processors of the affinity mask, or of the quota where that is smaller; at least 1.
int usable_cores();

}  // namespace footwall
