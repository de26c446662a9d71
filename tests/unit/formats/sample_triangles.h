// A surface for the writers: a strip of `count` triangles of which no two vertices are alike.
#pragma once
#include <cstring>
#include <string>

#include "storage/formats/triangle_source.h"

namespace footwall::formats {

inline std::array<double, 3> sample_position(std::uint64_t n) {
  return {458177.125 + static_cast<double>(n / 2), 7322538.712891 + static_cast<double>(n % 2),
          -1643.655884 - static_cast<double>(n) / 8};
}

inline TriangleSource sample_triangles(std::uint64_t count, bool normals = true) {
  TriangleSource source;
  source.vertices = count + 2;
  source.triangles = count;
  source.has_normals = normals;
  source.positions = [](std::uint64_t first, std::span<std::array<double, 3>> into) {
    for (std::size_t n = 0; n < into.size(); ++n) into[n] = sample_position(first + n);
  };
  source.normals = [](std::uint64_t first, std::span<std::array<float, 3>> into) {
    for (std::size_t n = 0; n < into.size(); ++n) into[n] = {0, 0.5F, static_cast<float>(first + n)};
  };
  source.corners = [](std::uint64_t first, std::span<std::array<std::uint32_t, 3>> into) {
    for (std::size_t n = 0; n < into.size(); ++n) {
      const auto at = static_cast<std::uint32_t>(first + n);
      into[n] = {at, at + 1, at + 2};
    }
  };
  return source;
}

// Enough that the writers take three parts.
inline constexpr std::uint64_t kManyTriangles = 2 * TriangleSource::kPart + 5;

template <class Value>
Value value_at(const std::string& bytes, std::size_t at) {
  Value value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

}  // namespace footwall::formats
