#include "engine/extract/probes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "engine/extract/exchange/exchange.h"
#include "engine/extract/fault_side.h"
#include "engine/extract/statistics/profile.h"

namespace footwall::extract {
namespace {

constexpr std::array kContrastShifts{-kContrastShift, kContrastShift};
constexpr std::array kOffsetShifts{-8, -7, -6, -5, -4, -3, -2, -1, 1, 2, 3, 4, 5, 6, 7, 8};
static_assert(kOffsetShifts.back() == kFarthestShift);

// What is in memory at once: 200 bytes each at its responsible rank, 100 on the way.
constexpr std::size_t kProbesAtOnce = std::size_t{1} << 17;

// Probes of faces [first, last).
struct Probes {
  struct Of {
    std::size_t face;
    int shift;
  };
  std::vector<Face> faces;
  std::vector<Of> of;            // of each: the face that it is a copy of, and where
  std::vector<int> responsible;  // the rank of that face, so that all its numbers meet there
};

Probes probes_of(const Setup& setup, std::span<const int> shifts, std::size_t first, std::size_t last) {
  Probes probes;
  for (std::size_t n = first; n < last; ++n) {
    for (const int shift : shifts) {
      const auto moved = shifted(setup.face(n).triangle, shift);
      if (!moved) continue;
      Face probe = setup.face(n);
      probe.triangle = *moved;
      probes.faces.push_back(probe);
      probes.of.push_back({n, shift});
      probes.responsible.push_back(setup.responsible[n]);
    }
  }
  return probes;
}

void combine(const Options& options, const Profile& profile, FaceStatistics& face) {
  if (asks_for(options, "contrast")) face.contrast = profile.contrast(face.discontinuity);
  if (asks_for(options, "offset")) {
    const Profile::Peak peak = profile.peak();
    face.offset_voxels = peak.shift;
    face.offset_score = peak.score;
  }
}

}  // namespace

std::span<const int> probe_shifts(const Options& options) {
  if (asks_for(options, "offset")) return kOffsetShifts;
  if (asks_for(options, "contrast")) return kContrastShifts;
  return {};
}

std::optional<survey::LatticeTriangle> shifted(const survey::LatticeTriangle& triangle, int shift) {
  const auto exact = exact_normal(triangle);
  std::array<double, 3> normal{};
  for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] = static_cast<double>(exact[axis]);
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  if (length == 0) return std::nullopt;
  std::array<std::int64_t, 3> step{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double distance = normal[axis] * (shift * survey::kLatticePerVoxel) / length;
    step[axis] = static_cast<std::int64_t>(std::nearbyint(distance));
  }
  survey::LatticeTriangle moved = triangle;
  for (survey::LatticePoint& p : moved) {
    for (const auto& [place, by] : {std::pair{&p.i, step[0]}, {&p.j, step[1]}, {&p.k, step[2]}}) {
      const std::int64_t to = *place + by;
      if (std::abs(to) > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
      *place = static_cast<std::int32_t>(to);
    }
  }
  return moved;
}

void run_probes(const Setup& setup, const JobContext& job, Outcome& outcome) {
  const std::span<const int> shifts = probe_shifts(setup.options);
  if (shifts.empty()) return;
  const std::size_t faces = setup.input.faces.size();
  const std::size_t at_once = kProbesAtOnce / shifts.size();
  // 1 Where each face of this rank stands.
  const auto place = setup.world.collectively([&] {
    require(setup.with_discontinuity, "discontinuities to compare probes with");
    std::vector<std::size_t> places(faces);
    for (std::size_t n = 0; n < outcome.finished.size(); ++n)
      places[static_cast<std::size_t>(outcome.finished[n].face)] = n;
    return places;
  });
  for (std::size_t first = 0; first < faces; first += at_once) {
    // 2 The probes of some faces, the same on every rank, are folded as faces are.
    const std::size_t last = std::min(faces, first + at_once);
    const Probes probes = setup.world.collectively([&] { return probes_of(setup, shifts, first, last); });
    const double all = static_cast<double>(faces);
    const JobContext part = job.part(static_cast<double>(first) / all, static_cast<double>(last) / all);
    const Input input{setup.input.dims, setup.input.max_abs, probes.faces};
    const Setup probing{.world = setup.world,
                        .grid = setup.grid,
                        .blocks = setup.blocks,
                        .cache = setup.cache,
                        .sent = setup.sent,
                        .input = input,
                        .responsible = probes.responsible,
                        .options = setup.options,
                        .choice = setup.choice,
                        .with_discontinuity = true,
                        .scale = setup.scale,
                        .whole_face = {},
                        .threads = setup.threads,
                        .kept = setup.kept,
                        .job = part};
    const Outcome probed = exchange_reduce(probing);
    setup.world.agree(probed.failure);
    // 3 The responsible rank compares them with their face.
    setup.world.collectively([&] {
      std::vector<Profile> profiles(last - first);
      for (const Finished& one : probed.finished) {
        const Probes::Of& of = probes.of[static_cast<std::size_t>(one.face)];
        profiles[of.face - first].set(of.shift, one.statistics.count, one.statistics.discontinuity);
      }
      for (std::size_t n = first; n < last; ++n) {
        if (!setup.mine(n)) continue;
        FaceStatistics& face = outcome.finished[place[n]].statistics;
        Profile& profile = profiles[n - first];
        if (shifted(setup.face(n).triangle, 0)) profile.set(0, face.count, face.discontinuity);
        combine(setup.options, profile, face);
      }
    });
    outcome.seconds.voxelize += probed.seconds.voxelize;
    outcome.seconds.exchange += probed.seconds.exchange;
    outcome.seconds.compute += probed.seconds.compute;
    outcome.seconds.wait += probed.seconds.wait;
  }
}

void orient_offsets(std::span<const Face> faces, std::span<FaceStatistics> statistics) {
  require(faces.size() == statistics.size(), "statistics of every face");
  std::map<std::int64_t, std::array<Int128, 3>> sums;
  for (const Face& face : faces) {
    const auto normal = exact_normal(face.triangle);
    auto& sum = sums[face.fault];
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += normal[axis];
  }
  for (std::size_t n = 0; n < faces.size(); ++n) {
    double& offset = statistics[n].offset_voxels;
    // Not -0: a face on the spot is on no side. Nor a NaN of the other sign: the one for undefined is the
    // same everywhere, down to its bits.
    if (offset != 0 && !std::isnan(offset) && side_of(sums[faces[n].fault]) < 0) offset = -offset;
  }
}

}  // namespace footwall::extract
