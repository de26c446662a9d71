#include "engine/render/composite/geometry_bytes.h"

#include <cstring>

namespace footwall::render {
namespace {

// A surface begins with this; the arrays follow in this order.
struct Head {
  std::array<double, 9> linear;
  std::array<double, 3> shift;
  std::uint64_t vertices;
  std::uint64_t triangles;
  std::uint64_t runs;
  std::uint64_t colour;
};
struct WireRun {
  std::uint64_t first_triangle;
  std::uint64_t first_id;
};

template <class T>
void append(std::span<const T> values, comm::Bytes& to) {
  const std::span<const std::byte> bytes = std::as_bytes(values);
  to.insert(to.end(), bytes.begin(), bytes.end());
}

template <class T>
void take(std::span<const std::byte>& from, std::span<T> to) {
  if (from.size() < to.size_bytes()) throw Error(ErrorCode::kCorrupt, "a rank's surface is not whole");
  if (!to.empty()) std::memcpy(to.data(), from.data(), to.size_bytes());
  from = from.subspan(to.size_bytes());
}

template <class T>
void take(std::span<const std::byte>& from, std::uint64_t count, std::vector<T>& to) {
  if (count > from.size() / sizeof(T)) throw Error(ErrorCode::kCorrupt, "a rank's surface is not whole");
  to.resize(count);
  take(from, std::span(to));
}

}  // namespace

std::int64_t size_of(std::span<const LitSurface> surfaces) {
  std::size_t all = 0;
  for (const LitSurface& surface : surfaces) {
    all += sizeof(Head) + surface.positions.size_bytes() + surface.normals.size_bytes() +
           surface.triangles.size_bytes() + surface.runs.size() * sizeof(WireRun);
  }
  return static_cast<std::int64_t>(all);
}

comm::Bytes bytes_of(std::span<const LitSurface> surfaces) {
  comm::Bytes bytes;
  bytes.reserve(static_cast<std::size_t>(size_of(surfaces)));
  for (const LitSurface& surface : surfaces) {
    const Vec3& shift = surface.placement.shift;
    const Head head{surface.placement.linear, {shift.x, shift.y, shift.z}, surface.positions.size(),
                    surface.triangles.size(), surface.runs.size(),         surface.colour};
    std::vector<WireRun> runs;
    for (const IdRun& run : surface.runs) runs.push_back({run.first_triangle, run.first_id});
    append(std::span(&head, 1), bytes);
    append(surface.positions, bytes);
    append(surface.normals, bytes);
    append(surface.triangles, bytes);
    append(std::span<const WireRun>(runs), bytes);
  }
  return bytes;
}

std::vector<OwnedSurface> surfaces_from(std::span<const std::byte> bytes) {
  std::vector<OwnedSurface> surfaces;
  while (!bytes.empty()) {
    Head head{};
    take(bytes, std::span(&head, 1));
    OwnedSurface& surface = surfaces.emplace_back();
    surface.colour = static_cast<Rgba>(head.colour);
    surface.placement = {head.linear, {head.shift[0], head.shift[1], head.shift[2]}};
    std::vector<WireRun> runs;
    take(bytes, head.vertices, surface.positions);
    take(bytes, head.vertices, surface.normals);
    take(bytes, head.triangles, surface.triangles);
    take(bytes, head.runs, runs);
    for (const WireRun& run : runs)
      surface.runs.push_back({run.first_triangle, static_cast<PrimitiveId>(run.first_id)});
  }
  return surfaces;
}

}  // namespace footwall::render
