#include "storage/formats/segy/stray_positions.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kFewest = 16;  // traces; of less nobody can tell which are the wild ones
constexpr std::int64_t kMostSampled = std::int64_t{1} << 20;
constexpr int kMostRounds = 12;

// Calls visit(entry, offset) for each trace that has coordinates.
template <class Visit>
void for_each_position(const HeaderScan& scan, const Visit& visit) {
  for (const IndexEntry& entry : scan.index.entries()) {
    const Offset2 offset = scan.offsets[static_cast<std::size_t>(entry.trace())];
    if (std::isfinite(offset.x) && std::isfinite(offset.y)) visit(entry, offset);
  }
}

double distance_from(const MapFit& fit, const HeaderScan& scan, const IndexEntry& entry,
                     const Offset2& offset) {
  const double u = entry.inline_number - fit.u0;
  const double v = entry.crossline_number - fit.v0;
  const double x = fit.origin_x - scan.positions.x0 + fit.per_u_x * u + fit.per_v_x * v;
  const double y = fit.origin_y - scan.positions.y0 + fit.per_u_y * u + fit.per_v_y * v;
  return std::hypot(x - static_cast<double>(offset.x), y - static_cast<double>(offset.y));
}

float median_of(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The middle of all positions, and a radius that holds any survey's traces but no wild one.
struct Middle {
  double x = 0, y = 0, radius = 0;
};
Middle middle_of(const HeaderScan& scan) {
  std::vector<float> x, y, distance;
  const auto every = static_cast<std::int64_t>(scan.index.entries().size()) / kMostSampled + 1;
  std::int64_t n = 0;
  for_each_position(scan, [&](const IndexEntry&, const Offset2& offset) {
    if (n++ % every != 0) return;
    x.push_back(offset.x);
    y.push_back(offset.y);
  });
  const float middle_x = median_of(x);
  const float middle_y = median_of(y);
  for (std::size_t at = 0; at < x.size(); ++at)
    distance.push_back(std::hypot(x[at] - middle_x, y[at] - middle_y));
  constexpr double kWide = 50;
  return {static_cast<double>(middle_x), static_cast<double>(middle_y),
          kWide * static_cast<double>(median_of(std::move(distance)))};
}

struct Kept {
  Moments moments;
  std::int64_t left_out = 0;
  double largest_offset = 0;
};
template <class Keep>
Kept keep_if(const HeaderScan& scan, const Keep& keep) {
  Kept kept;
  for_each_position(scan, [&](const IndexEntry& entry, const Offset2& offset) {
    if (!keep(entry, offset)) {
      ++kept.left_out;
      return;
    }
    const auto x = static_cast<double>(offset.x);
    const auto y = static_cast<double>(offset.y);
    kept.largest_offset = std::max({kept.largest_offset, std::abs(x), std::abs(y)});
    kept.moments.add(entry.inline_number, entry.crossline_number, scan.positions.x0 + x,
                     scan.positions.y0 + y);
  });
  return kept;
}

// Offsets are floats from the first trace: if that is the wild one they are too coarse.
bool fine_enough(const Kept& kept, const MapFit& fit) {
  constexpr double kFloatStep = 1.0 / (1 << 24);
  return kept.largest_offset * kFloatStep <= 0.01 * bin_of(fit);
}

}  // namespace

std::optional<FitWithoutStrays> fit_without_strays(const HeaderScan& scan, const MapFit& all) {
  std::int64_t positions = 0;
  for_each_position(scan, [&](const IndexEntry&, const Offset2&) { ++positions; });
  if (positions < kFewest) return std::nullopt;
  const std::int64_t most = std::max<std::int64_t>(1, positions / 50);

  // 1. What lies far beyond any survey; it can tilt the fit so much that no other test would see it.
  const Middle middle = middle_of(scan);
  Kept kept = keep_if(scan, [&](const IndexEntry&, const Offset2& offset) {
    return std::hypot(static_cast<double>(offset.x) - middle.x, static_cast<double>(offset.y) - middle.y) <=
           middle.radius;
  });
  MapFit fit = kept.left_out > 0 ? fit_map(kept.moments) : all;

  // 2. What lies far off the others' grid, until nothing more does.
  for (int round = 0; round < kMostRounds; ++round) {
    if (kept.left_out > most || fit.kind == MapFit::Kind::kUnusable || fit.kind == MapFit::Kind::kPoint) {
      return std::nullopt;
    }
    const bool on_grid = misfit_in_bins(fit) <= 0.1;
    const double farthest = on_grid ? bin_of(fit) : 3 * fit.residual;
    const std::int64_t before = kept.left_out;
    kept = keep_if(scan, [&](const IndexEntry& entry, const Offset2& offset) {
      return distance_from(fit, scan, entry, offset) <= farthest;
    });
    fit = fit_map(kept.moments);
    if (on_grid && kept.left_out == before) {
      if (kept.left_out == 0 || !fine_enough(kept, fit)) return std::nullopt;
      return FitWithoutStrays{fit, farthest, kept.left_out};
    }
  }
  return std::nullopt;
}

}  // namespace footwall::formats::segy
