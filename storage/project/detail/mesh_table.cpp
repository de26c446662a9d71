#include "storage/project/detail/mesh_table.h"

#include <fmt/format.h>
#include <cmath>

#include "storage/project/detail/clock.h"
#include "storage/project/detail/packing.h"

namespace footwall::project::detail {
namespace {

// One array after another: owner, n, kind, position.
constexpr std::size_t kVertexBytes = 8 + 4 + 1 + 24;
// panel, n, corners.
constexpr std::size_t kFaceBytes = 8 + 4 + 12;

void check_mesh(const MeshRecord& mesh, std::int64_t fault, ErrorCode code) {
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  for (const MeshVertex& v : mesh.vertices) {
    const survey::WorldPoint& p = v.position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw Error(code, fmt::format("the mesh of fault {} has a vertex that is not finite", fault));
    }
  }
  for (const MeshFace& face : mesh.faces) {
    for (const std::int32_t corner : face.vertices) {
      if (corner < 0 || corner >= count) {
        throw Error(code, fmt::format("face {}.{} of fault {} has vertex {} of {}", face.panel, face.n, fault,
                                      corner, count));
      }
    }
  }
}

Bytes pack(const std::vector<MeshVertex>& vertices) {
  const std::size_t n = vertices.size();
  std::vector<std::int64_t> owners(n);
  std::vector<std::int32_t> numbers(n);
  std::vector<std::uint8_t> kinds(n);
  std::vector<survey::WorldPoint> positions(n);
  for (std::size_t v = 0; v < n; ++v) {
    owners[v] = vertices[v].owner;
    numbers[v] = vertices[v].n;
    kinds[v] = static_cast<std::uint8_t>(vertices[v].kind);
    positions[v] = vertices[v].position;
  }
  Bytes bytes;
  bytes.reserve(n * kVertexBytes);
  append(bytes, std::span<const std::int64_t>(owners));
  append(bytes, std::span<const std::int32_t>(numbers));
  append(bytes, std::span<const std::uint8_t>(kinds));
  append(bytes, std::span<const survey::WorldPoint>(positions));
  return bytes;
}

Bytes pack(const std::vector<MeshFace>& faces) {
  const std::size_t n = faces.size();
  std::vector<std::int64_t> panels(n);
  std::vector<std::int32_t> numbers(n);
  std::vector<std::array<std::int32_t, 3>> corners(n);
  for (std::size_t f = 0; f < n; ++f) {
    panels[f] = faces[f].panel;
    numbers[f] = faces[f].n;
    corners[f] = faces[f].vertices;
  }
  Bytes bytes;
  bytes.reserve(n * kFaceBytes);
  append(bytes, std::span<const std::int64_t>(panels));
  append(bytes, std::span<const std::int32_t>(numbers));
  append(bytes, std::span<const std::array<std::int32_t, 3>>(corners));
  return bytes;
}

// The element at `index` of an array of T; the caller has checked the size.
template <class T>
T element(const std::byte* array, std::size_t index) {
  T value;
  std::memcpy(&value, array + index * sizeof(T), sizeof(T));
  return value;
}

// bytes holds n elements, as pack() laid them out.
void unpack(std::span<const std::byte> bytes, std::size_t n, std::vector<MeshVertex>& vertices) {
  const std::byte* owners = bytes.data();
  const std::byte* numbers = owners + n * sizeof(std::int64_t);
  const std::byte* kinds = numbers + n * sizeof(std::int32_t);
  const std::byte* positions = kinds + n;
  vertices.reserve(n);
  for (std::size_t v = 0; v < n; ++v) {
    const auto kind = kinds[v] == std::byte{0} ? MeshVertex::Owner::kPillar : MeshVertex::Owner::kPanel;
    vertices.push_back({kind, element<std::int64_t>(owners, v), element<std::int32_t>(numbers, v),
                        element<survey::WorldPoint>(positions, v)});
  }
}

void unpack(std::span<const std::byte> bytes, std::size_t n, std::vector<MeshFace>& faces) {
  const std::byte* panels = bytes.data();
  const std::byte* numbers = panels + n * sizeof(std::int64_t);
  const std::byte* corners = numbers + n * sizeof(std::int32_t);
  faces.reserve(n);
  for (std::size_t f = 0; f < n; ++f) {
    faces.push_back({element<std::int64_t>(panels, f), element<std::int32_t>(numbers, f),
                     element<std::array<std::int32_t, 3>>(corners, f)});
  }
}

template <class Element>
void read_rows(Query& row, std::string_view what, std::size_t element_bytes, std::vector<Element>& elements) {
  if (!row.next()) throw Error(ErrorCode::kCorrupt, fmt::format("{} are missing", what));
  const auto bytes = row.view(1);
  require_size(what, bytes.size(), row.integer(0), element_bytes);
  unpack(bytes, static_cast<std::size_t>(row.integer(0)), elements);
}

}  // namespace

std::optional<MeshRecord> MeshTable::read(std::int64_t fault) const {
  Query head(database_, "SELECT revision, algorithm, parameters, chart FROM mesh WHERE fault = ?", fault);
  if (!head.next()) return std::nullopt;
  MeshRecord mesh;
  mesh.revision = head.integer(0);
  mesh.algorithm = head.text(1);
  mesh.parameters = head.text(2);
  mesh.chart = head.blob(3);
  Query vertices(database_, "SELECT count, data FROM mesh_vertex WHERE fault = ?", fault);
  read_rows(vertices, fmt::format("the mesh vertices of fault {}", fault), kVertexBytes, mesh.vertices);
  Query faces(database_, "SELECT count, data FROM mesh_face WHERE fault = ?", fault);
  read_rows(faces, fmt::format("the mesh faces of fault {}", fault), kFaceBytes, mesh.faces);
  check_mesh(mesh, fault, ErrorCode::kCorrupt);
  return mesh;
}

std::int64_t MeshTable::revision(std::int64_t fault) const {
  Query row(database_, "SELECT revision FROM mesh WHERE fault = ?", fault);
  return row.next() ? row.integer(0) : 0;
}

void MeshTable::write(std::int64_t fault, const MeshRecord& mesh) {
  check_mesh(mesh, fault, ErrorCode::kInvalid);
  const Bytes vertices = pack(mesh.vertices);
  const Bytes faces = pack(mesh.faces);
  Query(database_, "DELETE FROM mesh_vertex WHERE fault = ?", fault).run();
  Query(database_, "DELETE FROM mesh_face WHERE fault = ?", fault).run();
  Query(database_,
        "INSERT OR REPLACE INTO mesh(fault, revision, algorithm, parameters, made, chart) VALUES(?, ?, ?, ?, "
        "?, ?)",
        fault, mesh.revision, mesh.algorithm, mesh.parameters, now_text(), mesh.chart)
      .run();
  Query(database_, "INSERT INTO mesh_vertex(fault, count, data) VALUES(?, ?, ?)", fault,
        static_cast<std::int64_t>(mesh.vertices.size()), vertices)
      .run();
  Query(database_, "INSERT INTO mesh_face(fault, count, data) VALUES(?, ?, ?)", fault,
        static_cast<std::int64_t>(mesh.faces.size()), faces)
      .run();
}

void MeshTable::remove_all() {
  database_.exec("DELETE FROM mesh_vertex; DELETE FROM mesh_face; DELETE FROM mesh");
}

}  // namespace footwall::project::detail
