// Named colour maps and the ranges that they are stretched over.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/render/colour.h"

namespace footwall::render {

struct Range {
  double lo = 0;
  double hi = 1;
};

enum class ColourMapKind : std::uint8_t { kSequential, kDiverging };

class ColourMap {
 public:
  static constexpr Rgba kUndefined = hex(0x6b7079);  // for values that are not a number

  // viridis, cividis, grey (sequential); red-white-blue, seismic (diverging: the middle stands for zero).
  // Throws Error kUsage, listing the names, for any other.
  static const ColourMap& named(std::string_view name);
  static std::span<const ColourMap> all();

  std::string_view name() const { return name_; }
  ColourMapKind kind() const { return kind_; }
  // Values below lo take the first colour, above hi the last; an empty range (hi <= lo) the middle one.
  Rgba colour_of(double value, double lo, double hi) const;
  Rgba colour_of(double value, const Range& range) const { return colour_of(value, range.lo, range.hi); }
  const std::array<Rgba, 256>& table() const { return table_; }

  ColourMap(std::string_view name, ColourMapKind kind, std::span<const std::uint32_t> control_points);

 private:
  std::string_view name_;
  ColourMapKind kind_;
  std::array<Rgba, 256> table_{};
};

// From the low-th to the high-th percentile of the finite values; nothing if there are none. If both are the
// same value the range is widened around it, so that hi > lo always.
std::optional<Range> percentile_range(std::span<const double> values, double low = 2, double high = 98);
// Symmetric about zero: the percentile of |value|, for signed quantities.
std::optional<Range> symmetric_range(std::span<const float> values, double percentile = 99);

}  // namespace footwall::render
