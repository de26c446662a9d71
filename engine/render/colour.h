// RGBA8 packed as the picture's bytes are: red in the lowest byte.
#pragma once
#include <algorithm>
#include <cstdint>

namespace footwall::render {

using Rgba = std::uint32_t;

constexpr Rgba rgb(unsigned red, unsigned green, unsigned blue, unsigned alpha = 255) {
  return red | green << 8U | blue << 16U | alpha << 24U;
}
// From 0xRRGGBB, as colours are usually written.
constexpr Rgba hex(std::uint32_t rrggbb) {
  return rgb(rrggbb >> 16U & 255U, rrggbb >> 8U & 255U, rrggbb & 255U);
}
constexpr unsigned red(Rgba c) {
  return c & 255U;
}
constexpr unsigned green(Rgba c) {
  return c >> 8U & 255U;
}
constexpr unsigned blue(Rgba c) {
  return c >> 16U & 255U;
}
constexpr unsigned alpha(Rgba c) {
  return c >> 24U;
}

// share 0 gives a, 1 gives b; channel by channel, as stored (not in linear light).
constexpr Rgba mixed(Rgba a, Rgba b, double share) {
  const auto channel = [share](unsigned from, unsigned to) {
    return static_cast<unsigned>(from + (static_cast<double>(to) - from) * share + 0.5);
  };
  return rgb(channel(red(a), red(b)), channel(green(a), green(b)), channel(blue(a), blue(b)),
             channel(alpha(a), alpha(b)));
}
// The colour at `intensity` of its brightness; above 1 it saturates.
constexpr Rgba scaled(Rgba c, double intensity) {
  const auto channel = [intensity](unsigned v) {
    return static_cast<unsigned>(std::clamp(v * intensity + 0.5, 0.0, 255.0));
  };
  return rgb(channel(red(c)), channel(green(c)), channel(blue(c)), alpha(c));
}

}  // namespace footwall::render
