#include "engine/tasks/detail/voxelize_published.h"

namespace footwall::tasks {
namespace {

constexpr std::array kWall = {
    PublishedTimes{"P4", "gpu-voxelize", {1.30, 1.55, 1.62, 1.81, 7.80, 75.55, 346.81}},
    PublishedTimes{"P4", "cpu-voxelize-1cpu", {0.33, 0.34, 0.44, 1.28, 10.44, 161.32, 582.42}},
    PublishedTimes{"Xeon", "gpu-voxelize", {0.66, 0.68, 0.80, 2.26, 8.25, 64.51, 290.10}},
    PublishedTimes{"Xeon", "cpu-voxelize-1cpu", {0, 0.01, 0.06, 0.58, 6.38, 84.98, 316.79}},
    PublishedTimes{"Xeon", "cpu-voxelize-2cpu", {0.01, 0.02, 0.09, 0.61, 7.57, 108.01, 457.19}},
    PublishedTimes{"Xeon", "cpu-voxelize-4cpu", {0.04, 0.06, 0.11, 0.64, 7.72, 106.56, 411.68}},
    PublishedTimes{"Njord", "cpu-voxelize-1cpu", {0.02, 0.05, 0.28, 2.29, 24.74, 269.24, 972.51}},
    PublishedTimes{"Njord", "cpu-voxelize-2cpu", {0.02, 0.05, 0.22, 1.82, 17.71, 225.05, 720.10}},
    PublishedTimes{"Njord", "cpu-voxelize-4cpu", {0.03, 0.05, 0.19, 1.49, 14.67, 167.41, 635.16}},
    PublishedTimes{"Njord", "cpu-voxelize-8cpu", {0.04, 0.06, 0.17, 1.18, 11.17, 139.12, 503.32}},
    PublishedTimes{"Njord", "cpu-voxelize-16cpu", {0.06, 0.08, 0.20, 1.19, 11.67, 150.66, 553.74}},
    PublishedTimes{"Njord", "cpu-voxelize-32cpu", {0.08, 0.11, 0.30, 1.71, 17.94, 208.21, 824.46}},
};

constexpr std::array kCpu = {
    PublishedTimes{"P4", "gpu-voxelize", {1.10, 1.10, 1.11, 1.54, 7.09, 73.54, 338.18}},
    PublishedTimes{"P4", "cpu-voxelize-1cpu", {0.33, 0.34, 0.44, 1.28, 10.36, 158.40, 582.42}},
    PublishedTimes{"Xeon", "gpu-voxelize", {0.42, 0.42, 0.49, 1.51, 6.86, 56.11, 289.54}},
    PublishedTimes{"Xeon", "cpu-voxelize-1cpu", {0, 0.01, 0.06, 0.58, 6.37, 84.97, 316.78}},
};

}  // namespace

std::span<const PublishedTimes> published_wall_times() {
  return kWall;
}

std::span<const PublishedTimes> published_cpu_times() {
  return kCpu;
}

}  // namespace footwall::tasks
