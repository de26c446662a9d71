#include <algorithm>

#include "engine/isosurface/parallel/detail/spread_numbers.h"
#include "engine/isosurface/parallel/weld.h"

namespace footwall::isosurface {
namespace detail {

void spread_numbers(comm::Communicator& world, MeshPart& part) {
  world.collectively([&] {
    part.numbers.clear();
    part.numbers.reserve(part.mesh.positions.size());
    for (const Run& run : part.vertex_runs) {
      for (std::uint32_t n = 0; n < run.count; ++n)
        part.numbers.push_back(static_cast<std::uint32_t>(run.first + n));
    }
  });
  const std::vector<std::uint32_t> others =
      fetch_for_guests<std::uint32_t>(world, part, std::span(part.numbers).first(part.own));
  part.numbers.insert(part.numbers.end(), others.begin(), others.end());
}

}  // namespace detail

namespace {

constexpr std::uint32_t kGone = 0xffffffffU;

// The runs with what is left of them; runs of which nothing is left go.
template <class IsKept>
std::vector<Run> thinned(const std::vector<Run>& runs, const IsKept& is_kept) {
  std::vector<Run> left;
  std::size_t at = 0;
  for (const Run& run : runs) {
    Run some{run.slot, 0, 0};
    for (std::uint32_t n = 0; n < run.count; ++n, ++at) some.count += is_kept(at) ? 1 : 0;
    if (some.count > 0) left.push_back(some);
  }
  return left;
}

template <class T>
void copy_kept(const PageVector<T>& from, const std::vector<std::uint32_t>& places, std::size_t count,
               PageVector<T>& to) {
  if (from.empty()) return;
  to.resize_uninitialised(count);
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (places[n] != kGone) to[places[n]] = from[n];
  }
}

}  // namespace

MeshPart keep(comm::Communicator& world, const MeshPart& part, std::span<const std::uint8_t> kept) {
  const std::vector<std::uint8_t> guests_kept = fetch_for_guests<std::uint8_t>(world, part, kept);
  MeshPart left;
  world.collectively([&] {
    require(kept.size() == part.own, "one flag for each own vertex");
    left.volume = part.volume;
    left.vertex_slots = part.vertex_slots;
    left.triangle_slots = part.triangle_slots;
    left.computed = part.computed;
    std::vector<std::uint32_t> places(part.mesh.positions.size(), kGone);
    std::uint32_t count = 0;
    for (std::size_t n = 0; n < part.own; ++n) {
      if (kept[n] != 0) places[n] = count++;
    }
    left.own = count;
    std::size_t guest = part.own;
    for (const std::uint32_t some : part.asked_from) {
      const std::uint32_t before = count;
      for (std::uint32_t n = 0; n < some; ++n, ++guest) {
        if (guests_kept[guest - part.own] != 0) places[guest] = count++;
      }
      left.asked_from.push_back(count - before);
    }
    left.asked_by.resize(part.asked_by.size());
    for (std::size_t rank = 0; rank < part.asked_by.size(); ++rank) {
      for (const std::uint32_t vertex : part.asked_by[rank]) {
        if (places[vertex] != kGone) left.asked_by[rank].push_back(places[vertex]);
      }
    }
    copy_kept(part.mesh.positions, places, count, left.mesh.positions);
    copy_kept(part.mesh.normals, places, count, left.mesh.normals);
    copy_kept(part.mesh.keys, places, count, left.mesh.keys);
    const auto stays = [&](std::size_t triangle) {
      return places[part.mesh.triangles[triangle][0]] != kGone;
    };
    left.vertex_runs = thinned(part.vertex_runs, [&](std::size_t vertex) { return kept[vertex] != 0; });
    left.triangle_runs = thinned(part.triangle_runs, stays);
    std::size_t triangles = 0;
    for (const Run& run : left.triangle_runs) triangles += run.count;
    left.mesh.triangles.resize_uninitialised(triangles);
    std::size_t to = 0;
    for (std::size_t n = 0; n < part.mesh.triangles.size(); ++n) {
      if (!stays(n)) continue;
      const Triangle& old = part.mesh.triangles[n];
      left.mesh.triangles[to++] = {places[old[0]], places[old[1]], places[old[2]]};
    }
  });
  left.all_vertices = number_runs(world, left.vertex_slots, left.vertex_runs);
  left.all_triangles = number_runs(world, left.triangle_slots, left.triangle_runs);
  detail::spread_numbers(world, left);
  return left;
}

}  // namespace footwall::isosurface
