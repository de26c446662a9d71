// The operators on a set of meshes as plain values, which can be sent and stored.
// Based on: seed 004, section 2.7.4, and the operators of mesh.h beyond it.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/mesh/mesh.h"

namespace footwall::mesh {

using MeshId = std::int32_t;
using survey::LatticePoint;

// The new mesh's vertex v stands at positions[v], and face f joins the vertices faces[f]. The seed's makes
// one triangle.
struct CreateMesh {
  std::vector<LatticePoint> positions;
  std::vector<std::array<VertexId, 3>> faces;
  friend bool operator==(const CreateMesh&, const CreateMesh&) = default;
};

struct DestroyMesh {
  MeshId mesh = kNone;
  friend bool operator==(const DestroyMesh&, const DestroyMesh&) = default;
};

// On the free side of a border edge, with a new vertex at a position or with a vertex that is there.
struct AddFace {
  MeshId mesh = kNone;
  EdgeId border_edge = kNone;
  std::variant<LatticePoint, VertexId> apex;
  friend bool operator==(const AddFace&, const AddFace&) = default;
};

// All faces around a vertex, and the vertex.
struct RemoveFaces {
  MeshId mesh = kNone;
  VertexId vertex = kNone;
  friend bool operator==(const RemoveFaces&, const RemoveFaces&) = default;
};

// One face, and the vertices that are left without one.
struct RemoveFace {
  MeshId mesh = kNone;
  FaceId face = kNone;
  friend bool operator==(const RemoveFace&, const RemoveFace&) = default;
};

struct MoveVertex {
  MeshId mesh = kNone;
  VertexId vertex = kNone;
  LatticePoint to;
  friend bool operator==(const MoveVertex&, const MoveVertex&) = default;
};

struct SplitEdge {
  MeshId mesh = kNone;
  EdgeId edge = kNone;
  LatticePoint at;
  friend bool operator==(const SplitEdge&, const SplitEdge&) = default;
};

using Operation =
    std::variant<CreateMesh, DestroyMesh, AddFace, RemoveFaces, RemoveFace, MoveVertex, SplitEdge>;

// "CREATE-MESH" and so on.
std::string_view name_of(const Operation& operation);

// Little-endian, without alignment: an operation is its index in the variant as one byte and its members, 21
// bytes for a MOVE-VERTEX.
std::vector<std::byte> encode(std::span<const Operation> operations);
// The operations whose bytes these are; throws Error kFormat for bytes that are not whole operations, and
// takes no more memory than they need.
std::vector<Operation> decode(std::span<const std::byte> bytes);

}  // namespace footwall::mesh
