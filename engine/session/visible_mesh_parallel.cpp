#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/render/composite/send.h"
#include "engine/session/visible_mesh.h"
#include "storage/base/error.h"

namespace footwall::session {
namespace {

using isosurface::MeshPart;
using isosurface::Point;
using isosurface::Triangle;

constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kNone = 0xffffffffU;

// As they are sent.
struct SentVertex {
  Point position;
  Point normal;
};
struct SentTriangle {
  std::uint32_t number = 0;  // in the whole surface
  Triangle vertices{};
};
struct Sent {
  std::vector<SentVertex> vertices;
  std::vector<SentTriangle> triangles;
};

Point point_of(const render::Vec3f& v) {
  return {v.x, v.y, v.z};
}

[[noreturn]] void refuse() {
  throw Error(ErrorCode::kUnsupported, "what can be seen has more than 2^32 - 1 vertices or triangles",
              "ask for a smaller picture");
}

// What the triangles of a surface use, after that of others.
void add(const render::LitSurface& surface, Sent& to) {
  std::vector<std::uint32_t> place(surface.positions.size(), kNone);
  std::size_t run = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    while (run + 1 < surface.runs.size() && surface.runs[run + 1].first_triangle <= t) ++run;
    const std::size_t offset = t - surface.runs[run].first_triangle;
    SentTriangle sent{static_cast<std::uint32_t>(surface.runs[run].first_id + offset), {}};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto vertex = static_cast<std::size_t>(surface.triangles[t][corner]);
      if (place[vertex] == kNone) {
        if (to.vertices.size() >= kMost) refuse();
        place[vertex] = static_cast<std::uint32_t>(to.vertices.size());
        to.vertices.push_back({point_of(surface.positions[vertex]), point_of(surface.normals[vertex])});
      }
      sent.vertices[corner] = place[vertex];
    }
    to.triangles.push_back(sent);
  }
}

comm::Bytes bytes_of(const Sent& sent) {
  const std::uint64_t count = sent.vertices.size();
  const std::size_t vertices = count * sizeof(SentVertex);
  const std::size_t triangles = sent.triangles.size() * sizeof(SentTriangle);
  comm::Bytes bytes(sizeof count + vertices + triangles);
  std::memcpy(bytes.data(), &count, sizeof count);
  if (vertices > 0) std::memcpy(bytes.data() + sizeof count, sent.vertices.data(), vertices);
  if (triangles > 0) std::memcpy(bytes.data() + sizeof count + vertices, sent.triangles.data(), triangles);
  return bytes;
}

void append(const comm::Bytes& bytes, Sent& to) {
  std::uint64_t count = 0;
  std::memcpy(&count, bytes.data(), sizeof count);
  const std::size_t first = to.vertices.size();
  const std::size_t vertices = count * sizeof(SentVertex);
  const std::size_t triangles = (bytes.size() - sizeof count - vertices) / sizeof(SentTriangle);
  if (first + count > kMost) refuse();
  to.vertices.resize(first + count);
  if (vertices > 0) std::memcpy(to.vertices.data() + first, bytes.data() + sizeof count, vertices);
  const std::size_t first_triangle = to.triangles.size();
  to.triangles.resize(first_triangle + triangles);
  if (triangles > 0) {
    std::memcpy(to.triangles.data() + first_triangle, bytes.data() + sizeof count + vertices,
                triangles * sizeof(SentTriangle));
  }
  for (std::size_t t = first_triangle; t < to.triangles.size(); ++t) {
    for (std::uint32_t& vertex : to.triangles[t].vertices) vertex += static_cast<std::uint32_t>(first);
  }
}

// For each vertex the first one in memory that is the same.
std::vector<std::uint32_t> firsts_of(const std::vector<SentVertex>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto bits = [&](std::uint32_t n) {
    return std::bit_cast<std::array<std::uint32_t, sizeof(SentVertex) / sizeof(std::uint32_t)>>(vertices[n]);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto difference = bits(a) <=> bits(b);
    return difference != 0 ? difference < 0 : a < b;
  });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const bool is_new = n == 0 || bits(order[n - 1]) != bits(order[n]);
    first[order[n]] = is_new ? order[n] : first[order[n - 1]];
  }
  return first;
}

void weld(Sent& sent, isosurface::Surface& into) {
  if (sent.triangles.size() > kMost) refuse();
  std::sort(sent.triangles.begin(), sent.triangles.end(),
            [](const SentTriangle& a, const SentTriangle& b) { return a.number < b.number; });
  const std::vector<std::uint32_t> first = firsts_of(sent.vertices);
  std::vector<std::uint32_t> number(sent.vertices.size(), kNone);
  std::uint32_t count = 0;
  into.triangles.resize_uninitialised(sent.triangles.size());
  into.positions.resize_uninitialised(sent.vertices.size());
  into.normals.resize_uninitialised(sent.vertices.size());
  into.keys.resize_uninitialised(sent.vertices.size());
  for (std::size_t t = 0; t < sent.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = first[sent.triangles[t].vertices[corner]];
      if (number[vertex] == kNone) {
        into.positions[count] = sent.vertices[vertex].position;
        into.normals[count] = sent.vertices[vertex].normal;
        into.keys[count] = count;
        number[vertex] = count++;
      }
      into.triangles[t][corner] = number[vertex];
    }
  }
  into.positions.grow(count);
  into.normals.grow(count);
  into.keys.grow(count);
}

}  // namespace

MeshPart visible_mesh(comm::Communicator& world, const survey::Index& volume,
                      std::span<const render::LitSurface> surfaces) {
  Sent sent;
  const comm::Bytes mine = world.collectively([&] {
    for (const render::LitSurface& surface : surfaces) add(surface, sent);
    return world.rank() == 0 ? comm::Bytes() : bytes_of(sent);
  });
  const std::vector<comm::Bytes> others = render::gather_to_first(world, world.size(), mine);
  MeshPart part;
  part.volume = volume;
  part.asked_from.resize(static_cast<std::size_t>(world.size()));
  part.asked_by.resize(static_cast<std::size_t>(world.size()));
  part.vertex_slots = part.triangle_slots = 1;
  world.collectively([&] {
    if (world.rank() != 0) return;
    for (const comm::Bytes& other : others) append(other, sent);
    part.computed = sent.vertices.size();
    weld(sent, part.mesh);
    part.own = part.mesh.positions.size();
    part.numbers.resize(part.own);
    std::iota(part.numbers.begin(), part.numbers.end(), 0U);
    if (part.mesh.triangles.empty()) return;
    part.vertex_runs.push_back({0, static_cast<std::uint32_t>(part.own), 0});
    part.triangle_runs.push_back({0, static_cast<std::uint32_t>(part.mesh.triangles.size()), 0});
  });
  part.all_vertices = static_cast<std::uint64_t>(world.sum(static_cast<std::int64_t>(part.own)));
  part.all_triangles =
      static_cast<std::uint64_t>(world.sum(static_cast<std::int64_t>(part.mesh.triangles.size())));
  return part;
}

}  // namespace footwall::session
