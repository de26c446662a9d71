// Times for voxelizing 512 triangles as seed 004 published them, to stand beside our own.
#pragma once
#include <array>
#include <span>
#include <string_view>

namespace footwall::tasks {

// Mean areas in voxel^2 of the columns. The last one is headed 10^7 in tables 5.4 and F.6; the runs are those
// of table F.5, at half of that.
inline constexpr std::array<double, 7> kPublishedAreas = {10, 100, 1e3, 1e4, 1e5, 1e6, 5e6};

struct PublishedTimes {
  std::string_view machine;  // P4, Xeon (5160, 2007) or Njord (Power5+)
  std::string_view algorithm;
  std::array<double, 7> seconds;  // of 512 triangles, means of 20 runs; 0 = printed as "<0.01"
};

std::span<const PublishedTimes> published_wall_times();  // table F.5
std::span<const PublishedTimes> published_cpu_times();   // table F.6: user and system time

}  // namespace footwall::tasks
