// Control points: viridis by S. van der Walt and N. Smith (CC0), cividis by J. Nunez, C. Anderton and R.
// Renslow, "Optimizing colormaps with consideration for color vision deficiency" (2018), both sampled at
// equal steps; red-white-blue follows C. Brewer's RdBu (colorbrewer2.org); seismic is the blue-white-red that
// interpreters know under this name.
#include "engine/render/colour_map.h"

#include <fmt/format.h>
#include <iterator>

#include <algorithm>
#include <cmath>
#include <vector>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr std::uint32_t kViridis[] = {0x440154, 0x482878, 0x3e4a89, 0x31688e, 0x26828e,
                                      0x1f9e89, 0x35b779, 0x6dcd59, 0xb4de2c, 0xfde725};
constexpr std::uint32_t kCividis[] = {0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173,
                                      0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46};
constexpr std::uint32_t kGrey[] = {0x000000, 0xffffff};
constexpr std::uint32_t kRedWhiteBlue[] = {0x67001f, 0xb2182b, 0xd6604d, 0xf4a582, 0xfddbc7, 0xf7f7f7,
                                           0xd1e5f0, 0x92c5de, 0x4393c3, 0x2166ac, 0x053061};
constexpr std::uint32_t kSeismic[] = {0x00004d, 0x0000ff, 0xffffff, 0xff0000, 0x800000};

const std::array<ColourMap, 5>& maps() {
  static const std::array<ColourMap, 5> all{
      ColourMap("viridis", ColourMapKind::kSequential, kViridis),
      ColourMap("cividis", ColourMapKind::kSequential, kCividis),
      ColourMap("grey", ColourMapKind::kSequential, kGrey),
      ColourMap("red-white-blue", ColourMapKind::kDiverging, kRedWhiteBlue),
      ColourMap("seismic", ColourMapKind::kDiverging, kSeismic)};
  return all;
}

// The value below which `percent` of the (reordered) values lie, by the nearest rank.
template <class T>
double percentile(std::vector<T>& values, double percent) {
  const double rank = std::clamp(percent / 100, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto at = values.begin() + std::lround(rank);
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

Range widened(double lo, double hi) {
  if (hi > lo) return {lo, hi};
  const double by = lo == 0 ? 1 : std::abs(lo) * 0.5;
  return {lo - by, lo + by};
}

}  // namespace

ColourMap::ColourMap(std::string_view name, ColourMapKind kind, std::span<const std::uint32_t> control_points)
    : name_(name), kind_(kind) {
  const std::size_t spans = control_points.size() - 1;
  for (std::size_t n = 0; n < table_.size(); ++n) {
    const double at = static_cast<double>(n * spans) / static_cast<double>(table_.size() - 1);
    const std::size_t before = std::min(static_cast<std::size_t>(at), spans - 1);
    table_[n] =
        mixed(hex(control_points[before]), hex(control_points[before + 1]), at - static_cast<double>(before));
  }
}

const ColourMap& ColourMap::named(std::string_view name) {
  std::string names;
  for (const ColourMap& map : maps()) {
    if (map.name() == name) return map;
    names += (names.empty() ? "" : ", ") + std::string(map.name());
  }
  throw Error(ErrorCode::kUsage, fmt::format("there is no colour map '{}'", name), "use one of " + names);
}

std::span<const ColourMap> ColourMap::all() {
  return maps();
}

Rgba ColourMap::colour_of(double value, double lo, double hi) const {
  if (std::isnan(value)) return kUndefined;
  const double share = hi > lo ? std::clamp((value - lo) / (hi - lo), 0.0, 1.0) : 0.5;
  return table_[static_cast<std::size_t>(share * 255 + 0.5)];
}

std::optional<Range> percentile_range(std::span<const double> values, double low, double high) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double v) { return std::isfinite(v); });
  if (finite.empty()) return std::nullopt;
  const double lo = percentile(finite, low);
  return widened(lo, percentile(finite, high));
}

std::optional<Range> symmetric_range(std::span<const float> values, double percent) {
  std::vector<float> sizes;
  for (const float v : values) {
    if (std::isfinite(v)) sizes.push_back(std::abs(v));
  }
  if (sizes.empty()) return std::nullopt;
  const double most = percentile(sizes, percent);
  return most > 0 ? Range{-most, most} : Range{-1, 1};
}

}  // namespace footwall::render
