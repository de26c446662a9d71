// The pieces of all ranks as one mesh: each vertex belongs to one rank, and has the number that it has in a
// surface extracted in one piece.
//
// A vertex belongs to the rank of the cell that begins at the lower end of its lattice edge. Neighbours,
// which compute it too, bit for bit alike, find its number by one exchange: keys there, numbers back.
#pragma once
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/number_runs.h"
#include "engine/isosurface/parallel/piece.h"
#include "engine/isosurface/parallel/pillars.h"

namespace footwall::isosurface {

// What one rank has of a mesh that is spread over ranks. Vertices 0 .. own - 1 are its own; those after them,
// the guests, belong to other ranks, those of one rank together, and stand here because triangles of this
// rank use them. Own vertices and triangles stand in the order of their numbers.
struct MeshPart {
  survey::Index volume{0, 0, 0};
  Surface mesh;  // with keys; triangles name own vertices and guests; row_first and cells are not set
  std::size_t own = 0;
  std::vector<std::uint32_t> asked_from;  // by rank: guests that belong to it
  // By rank: own vertices that are guests there, in their order there.
  std::vector<std::vector<std::uint32_t>> asked_by;

  std::uint64_t all_vertices = 0;
  std::uint64_t all_triangles = 0;
  std::vector<std::uint32_t> numbers;  // of own vertices and guests in the whole mesh
  // Of own vertices and of triangles: those of a run stand together here, and in the whole mesh.
  std::vector<Run> vertex_runs;
  std::vector<Run> triangle_runs;
  std::uint64_t vertex_slots = 0;  // see number_runs.h
  std::uint64_t triangle_slots = 0;

  std::uint64_t computed = 0;  // vertices that this rank's pieces had, those between pieces more than once
};

// normals: whether the pieces have them. They must have keys, and are released. Collective. Throws on all
// ranks kUnsupported for 2^32 vertices or triangles or more, kMemory, kInternal where two ranks found one
// vertex at different places.
MeshPart weld(comm::Communicator& world, const Pillars& pillars, bool normals, std::vector<Piece>& pieces);

// For each guest what its owner has for it; own_values: one for each own vertex. Collective.
template <class T>
std::vector<T> fetch_for_guests(comm::Communicator& world, const MeshPart& part,
                                std::span<const T> own_values);

// Only what is kept of a mesh, numbered anew in the old order. kept: one for each own vertex, not zero if it
// is kept; a triangle is kept with its vertices, all or none of which are. Collective.
MeshPart keep(comm::Communicator& world, const MeshPart& part, std::span<const std::uint8_t> kept);

template <class T>
std::vector<T> fetch_for_guests(comm::Communicator& world, const MeshPart& part,
                                std::span<const T> own_values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<comm::Bytes> answers = world.collectively([&] {
    std::vector<comm::Bytes> bytes(part.asked_by.size());
    for (std::size_t rank = 0; rank < bytes.size(); ++rank) {
      bytes[rank].resize(part.asked_by[rank].size() * sizeof(T));
      std::byte* to = bytes[rank].data();
      for (const std::uint32_t vertex : part.asked_by[rank]) {
        std::memcpy(to, &own_values[vertex], sizeof(T));
        to += sizeof(T);
      }
    }
    return bytes;
  });
  answers = world.exchange(std::move(answers));
  return world.collectively([&] {
    std::vector<T> values(part.mesh.positions.size() - part.own);
    std::size_t at = 0;
    for (const comm::Bytes& bytes : answers) {
      if (!bytes.empty()) std::memcpy(values.data() + at, bytes.data(), bytes.size());
      at += bytes.size() / sizeof(T);
    }
    require(at == values.size(), "every guest has an answer");
    return values;
  });
}

}  // namespace footwall::isosurface
