// Random triangles of every ugly kind, the same on every machine.
#pragma once
#include <cstdint>
#include <string>

#include "storage/base/splitmix64.h"
#include "storage/survey/points.h"

namespace footwall::voxelize {

class Numbers : public SplitMix64 {
 public:
  using SplitMix64::SplitMix64;
  // least..most, both included.
  std::int32_t within(std::int64_t least, std::int64_t most) {
    const auto range = static_cast<std::uint64_t>(most - least + 1);
    return static_cast<std::int32_t>(least + static_cast<std::int64_t>(next() % range));
  }
};

enum class Kind { kAny, kInteger, kHalfInteger, kHalves, kAxisAligned, kSliver, kSegment, kPoint, kTiny };
inline constexpr Kind kAllKinds[] = {Kind::kAny,     Kind::kInteger,     Kind::kHalfInteger,
                                     Kind::kHalves,  Kind::kAxisAligned, Kind::kSliver,
                                     Kind::kSegment, Kind::kPoint,       Kind::kTiny};

// A triangle within +-extent lattice units of centre on each axis.
inline survey::LatticeTriangle make_triangle(Kind kind, std::int32_t extent,
                                             const survey::LatticePoint& centre, Numbers& numbers) {
  survey::LatticeTriangle t;
  const auto coordinate = [&] {
    const std::int32_t x = numbers.within(-extent, extent);
    switch (kind) {
      case Kind::kInteger:
        return x / 256 * 256;
      case Kind::kHalfInteger:
        return x / 256 * 256 + (x < 0 ? 128 : -128) * (x / 256 != 0);
      case Kind::kHalves:
        return x / 128 * 128;
      case Kind::kTiny:
        return x % 200;
      default:
        return x;
    }
  };
  for (auto& p : t) p = {coordinate(), coordinate(), coordinate()};
  if (kind == Kind::kAxisAligned) {
    const auto axis = numbers.next() % 3;
    for (auto& p : t)
      (axis == 0 ? p.i : axis == 1 ? p.j : p.k) = axis == 0 ? t[0].i : axis == 1 ? t[0].j : t[0].k;
  }
  if (kind == Kind::kSliver) {
    const auto near = [&](std::int32_t a, std::int32_t b) {
      const std::int32_t x = (a + b) / 2 + numbers.within(-2, 2);
      return x > extent ? extent : x < -extent ? -extent : x;
    };
    t[2] = {near(t[0].i, t[1].i), near(t[0].j, t[1].j), near(t[0].k, t[1].k)};
  }
  if (kind == Kind::kSegment) {
    const std::int32_t part = numbers.within(0, 4);  // of the way from corner 0 to 1, in quarters
    for (auto* p : {&t[1].i, &t[1].j, &t[1].k}) *p = *p / 4 * 4;
    for (auto* p : {&t[0].i, &t[0].j, &t[0].k}) *p = *p / 4 * 4;
    t[2] = {t[0].i + (t[1].i - t[0].i) / 4 * part, t[0].j + (t[1].j - t[0].j) / 4 * part,
            t[0].k + (t[1].k - t[0].k) / 4 * part};
  }
  if (kind == Kind::kPoint) t[1] = t[2] = t[0];
  for (auto& p : t) p = {p.i + centre.i, p.j + centre.j, p.k + centre.k};
  return t;
}

inline std::string text_of(const survey::LatticeTriangle& t) {
  std::string text;
  for (const auto& p : t)
    text += " (" + std::to_string(p.i) + "," + std::to_string(p.j) + "," + std::to_string(p.k) + ")";
  return text;
}

}  // namespace footwall::voxelize
