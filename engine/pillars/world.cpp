#include "engine/pillars/world.h"

#include <unordered_map>

namespace footwall::pillars {

std::vector<PillarInput> inputs_of(const survey::Geometry& survey, std::span<const survey::Pillar> pillars) {
  std::vector<PillarInput> out;
  out.reserve(pillars.size());
  for (const survey::Pillar& pillar : pillars) {
    PillarInput input{pillar.id, std::to_string(pillar.id), {}};
    for (const survey::PillarNode& node : pillar.nodes) {
      input.nodes.push_back(survey.index_of(node.position));
      input.node_ids.push_back(node.id);
    }
    out.push_back(std::move(input));
  }
  return out;
}

std::vector<survey::WorldPoint> world_vertices(const survey::Geometry& survey,
                                               std::span<const survey::Pillar> pillars,
                                               const FaultMesh& mesh) {
  std::unordered_map<std::int64_t, survey::WorldPoint> picked;
  for (const survey::Pillar& pillar : pillars) {
    for (const survey::PillarNode& node : pillar.nodes) picked.emplace(node.id, node.position);
  }
  std::vector<survey::WorldPoint> places;
  places.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices)
    places.push_back(vertex.node_id >= 0 ? picked.at(vertex.node_id) : survey.world_of(vertex.position));
  return places;
}

}  // namespace footwall::pillars
