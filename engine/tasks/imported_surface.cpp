#include "engine/tasks/imported_surface.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <numeric>

#include "engine/mesh/surface_facts.h"
#include "storage/base/error.h"
#include "storage/formats/z_unit.h"

namespace footwall::tasks {
namespace {

constexpr const char* kAlgorithm = "imported surface 1";

// The smallest vertex of the connected piece that a vertex belongs to.
class Pieces {
 public:
  explicit Pieces(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t of(std::int32_t vertex) {
    while (parent(vertex) != vertex) vertex = parent(vertex) = parent(parent(vertex));
    return vertex;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = of(a);
    b = of(b);
    parent(std::max(a, b)) = std::min(a, b);
  }

 private:
  std::int32_t& parent(std::int32_t vertex) { return parent_[static_cast<std::size_t>(vertex)]; }
  std::vector<std::int32_t> parent_;
};

}  // namespace

survey::Surface surface_in_survey(const project::Project& project, const project::SurfaceRecord& record) {
  survey::Surface surface = project.surface(record.id);
  const auto survey = project.survey();
  if (!survey) return surface;
  double across = 1, down = 1;
  try {
    across = formats::z_unit_factor(record.units.horizontal, survey->horizontal_unit);
    down = formats::z_unit_factor(record.units.vertical, name_of(survey->vertical_unit));
  } catch (const Error& error) {
    throw Error(ErrorCode::kInvalid, fmt::format("imported surface {}: {}", record.name, error.message()),
                "delete its fault, and import it again with --z-unit if its unit was not what it said");
  }
  if (across == 1 && down == 1) return surface;
  for (survey::WorldPoint& p : surface.vertices) p = {p.x * across, p.y * across, p.z * down};
  return surface;
}

project::MeshRecord imported_mesh(survey::Surface surface, std::int64_t revision,
                                  std::vector<std::string>& notes) {
  // 1. Let neighbours agree where they can, and cut what no mesh can hold.
  const std::vector<bool> turn = mesh::faces_to_turn(surface);
  if (const auto turned = std::count(turn.begin(), turn.end(), true); turned > 0) {
    notes.push_back(
        fmt::format("{}: the windings of neighbouring triangles disagree; {} of {} are turned in the mesh",
                    surface.name, turned, turn.size()));
    for (std::size_t f = 0; f < turn.size(); ++f) {
      if (turn[f]) std::swap(surface.triangles[f][1], surface.triangles[f][2]);
    }
  }
  const mesh::CutSurface cut = mesh::cut_into_manifold(surface);
  if (cut.cut_edges > 0 || cut.copied_vertices > 0) {
    notes.push_back(fmt::format("{}: cut along {} edges and apart at vertices, {} vertices copied",
                                surface.name, cut.cut_edges, cut.copied_vertices));
  }
  // 2. Number the pieces in the order of their first face.
  Pieces pieces(cut.source_vertex.size());
  for (const auto& face : cut.faces) {
    pieces.join(face[0], face[1]);
    pieces.join(face[0], face[2]);
  }
  project::MeshRecord mesh;
  mesh.revision = revision;
  mesh.algorithm = kAlgorithm;
  std::vector<std::int32_t> panel(cut.source_vertex.size(), 0);  // by piece; 0 = not met yet
  std::vector<std::int32_t> faces_in, vertices_in;
  mesh.faces.reserve(cut.faces.size());
  for (const auto& face : cut.faces) {
    std::int32_t& number = panel[static_cast<std::size_t>(pieces.of(face[0]))];
    if (number == 0) {
      faces_in.push_back(0);
      number = static_cast<std::int32_t>(faces_in.size());
    }
    mesh.faces.push_back({number, faces_in[static_cast<std::size_t>(number) - 1]++, face});
  }
  // 3. Vertices; one without a face is in piece 0.
  vertices_in.assign(faces_in.size() + 1, 0);
  mesh.vertices.reserve(cut.source_vertex.size());
  for (std::size_t v = 0; v < cut.source_vertex.size(); ++v) {
    const std::int32_t number = panel[static_cast<std::size_t>(pieces.of(static_cast<std::int32_t>(v)))];
    project::MeshVertex vertex;
    vertex.kind = project::MeshVertex::Owner::kPanel;
    vertex.owner = number;
    vertex.n = vertices_in[static_cast<std::size_t>(number)]++;
    vertex.position = surface.vertices[static_cast<std::size_t>(cut.source_vertex[v])];
    mesh.vertices.push_back(vertex);
  }
  return mesh;
}

bool is_imported(const project::MeshRecord& mesh) {
  return mesh.algorithm == kAlgorithm;
}

}  // namespace footwall::tasks
