#include "engine/tasks/doctor/recommendation.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/comm/rank_grid.h"
#include "engine/extract/balance/balance.h"
#include "engine/extract/cost/model.h"
#include "engine/extract/measure_rates.h"
#include "storage/base/cores.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

// The size of the seed's benchmark 2: what an interpreter's survey with many faults looks like, made smaller.
constexpr survey::Index kDims{200, 200, 100};
constexpr std::size_t kFaces = 10000;
constexpr std::int64_t kLegVoxels = 50;  // of faces of about 1,000 voxel^2

std::vector<extract::Face> some_faces() {
  std::uint64_t state = 1;
  const auto below = [&](std::int64_t end) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::int32_t>((state >> 33) % static_cast<std::uint64_t>(end));
  };
  std::vector<extract::Face> faces(kFaces);
  for (std::size_t n = 0; n < kFaces; ++n) {
    faces[n].owner = static_cast<std::int64_t>(n);
    std::array<std::int32_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      at[axis] = below((kDims[axis] - kLegVoxels) * survey::kLatticePerVoxel);
    for (survey::LatticePoint& p : faces[n].triangle) {
      constexpr std::int64_t kLeg = kLegVoxels * survey::kLatticePerVoxel;
      p = {at[0] + below(kLeg), at[1] + below(kLeg), at[2] + below(kLeg)};
    }
  }
  return faces;
}

}  // namespace

std::vector<Shape> shapes(const extract::MachineRates& rates, int cores, std::span<const double> slowdown) {
  require(cores >= 1 && slowdown.size() >= static_cast<std::size_t>(cores),
          "cores, and threads on each of them");
  const std::vector<extract::Face> faces = some_faces();
  const std::vector<std::int64_t> voxels = extract::expected_voxels(faces, kDims);
  const extract::Choice none = extract::parse_choice("none");
  std::vector<Shape> all;
  for (int ranks = 1; ranks <= cores; ++ranks) {
    if (cores % ranks != 0) continue;
    const comm::RankGrid grid(kDims, ranks);
    const auto amounts = extract::FaceSample(grid, faces, 0)
                             .amounts(extract::balance_strategy("none").run({grid, faces, none, {}}), voxels);
    extract::MachineRates here = rates;
    here.cores = cores;
    const int threads = cores / ranks;
    for (double extract::MachineRates::*rate : {&extract::MachineRates::fold, &extract::MachineRates::face})
      here.*rate *= slowdown[static_cast<std::size_t>(threads - 1)];
    const extract::Seconds seconds =
        extract::predict(extract::parse_choice("reduce"), {amounts, threads, false, 0, 0}, here);
    all.push_back({ranks, threads, seconds.total});
  }
  // What is no more than noise apart counts as equal.
  constexpr double kNoise = 1.02;
  const double least = std::min_element(all.begin(), all.end(), [](const Shape& a, const Shape& b) {
                         return a.seconds < b.seconds;
                       })->seconds;
  const auto rank_of = [&](const Shape& shape) { return std::max(shape.seconds, least * kNoise); };
  std::sort(all.begin(), all.end(), [&](const Shape& a, const Shape& b) {
    return rank_of(a) < rank_of(b) || (rank_of(a) == rank_of(b) && a.ranks > b.ranks);
  });
  return all;
}

Finding recommend_shape(const extract::MachineRates& rates) {
  // No more than so many threads are measured: beyond them the last measurement is taken.
  constexpr int kMostMeasured = 16;
  constexpr double kSeconds = 0.03;
  const int cores = usable_cores();
  const double alone = extract::measure_folding(1, kSeconds);
  std::vector<double> slowdown{1};
  for (int threads = 2; threads <= cores; ++threads) {
    const bool divides = cores % threads == 0;
    slowdown.push_back(threads <= kMostMeasured && divides
                           ? std::max(1.0, extract::measure_folding(threads, kSeconds) / alone)
                           : slowdown.back());
  }
  const std::vector<Shape> all = shapes(rates, cores, slowdown);
  constexpr double kMega = 1e6;
  constexpr double kGiga = 1e9;
  constexpr double kMilli = 1e3;
  std::string others;
  for (std::size_t n = 1; n < std::min<std::size_t>(all.size(), 3); ++n) {
    others += fmt::format("{}{} x {} {:.3g} ms", n == 1 ? "; " : ", ", all[n].ranks, all[n].threads,
                          kMilli * all[n].seconds);
  }
  return ok(fmt::format(
      "for this machine: --ranks {} --threads {} ({:.3g} ms predicted for 10,000 faces{}); latency {:.2g} "
      "us, "
      "{:.3g} GB/s between ranks; {:.0f} million voxels/s voxelized, {:.0f} folded by a core",
      all.front().ranks, all.front().threads, kMilli * all.front().seconds, others, kMega * rates.alpha,
      rates.byte > 0 ? 1 / (kGiga * rates.byte) : 0, 1 / (kMega * rates.voxelize), 1 / (kMega * rates.fold)));
}

}  // namespace footwall::tasks
