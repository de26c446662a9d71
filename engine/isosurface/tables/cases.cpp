#include "engine/isosurface/tables/cases.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "engine/isosurface/tables/cell.h"

namespace footwall::isosurface::tables {
namespace {

constexpr unsigned kTunnelBits[2] = {1U << 7, 1U << 6};  // of outside, of inside corners

Entry made(unsigned signs, unsigned joined, const Contours& contours, const std::optional<Tunnel>& tunnel) {
  const std::optional<Filling> filling = fill(contours, tunnel);
  if (!filling)
    throw std::runtime_error("no triangulation of signs " + std::to_string(signs) + " with joined faces " +
                             std::to_string(joined) + (tunnel ? " and a tunnel" : ""));
  return {*filling, static_cast<int>(contours.loops.size()), tunnel ? 1 : 0};
}

SignCase case_of(unsigned signs) {
  SignCase all;
  const unsigned ambiguous = ambiguous_faces(signs);
  for (unsigned joined = 0; joined < 64; ++joined) {
    if ((joined & ~ambiguous) != 0) continue;
    const Contours contours = trace(signs, joined);
    all.entries[joined] = made(signs, joined, contours, std::nullopt);
    all.fans[joined] = {fan(contours), static_cast<int>(contours.loops.size()), 0};
    for (const Tunnel& tunnel : tunnels(signs, joined, contours)) {
      const bool is_new =
          all.entries
              .emplace(joined | kTunnelBits[tunnel.inside ? 1 : 0], made(signs, joined, contours, tunnel))
              .second;
      if (!is_new) throw std::runtime_error("two tunnels of one sign in signs " + std::to_string(signs));
    }
  }
  return all;
}

Entry turned_over(Entry entry) {
  for (std::array<int, 3>& triangle : entry.filling.triangles) std::swap(triangle[1], triangle[2]);
  return entry;
}

SignCase complement(unsigned signs, const SignCase& original) {
  SignCase all;
  const auto other = [&](unsigned alternative) {
    const unsigned faces = (alternative & 63U) ^ ambiguous_faces(signs);
    return faces | (alternative & kTunnelBits[1]) << 1 | (alternative & kTunnelBits[0]) >> 1;
  };
  for (const auto& [alternative, entry] : original.entries)
    all.entries[other(alternative)] = turned_over(entry);
  for (const auto& [alternative, entry] : original.fans) all.fans[other(alternative)] = turned_over(entry);
  return all;
}

}  // namespace

std::vector<SignCase> all_cases() {
  std::vector<SignCase> all(256);
  for (unsigned signs = 0; signs < 128; ++signs) {
    all[signs] = case_of(signs);
    all[255 - signs] = complement(signs, all[signs]);
  }
  return all;
}

}  // namespace footwall::isosurface::tables
