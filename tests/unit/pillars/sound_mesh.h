// What every triangulated fault must be, whatever its pillars.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "engine/mesh/check.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/walk.h"
#include "engine/pillars/triangulate.h"
#include "unit/pillars/intersections.h"

namespace footwall::pillars::testing {

using survey::IndexPoint;

inline FaultMesh woven(const std::vector<PillarInput>& pillars, const Options& options = {},
                       const std::optional<Chart>& chart = std::nullopt) {
  return triangulate(pillars, options, chart, JobContext());
}

inline mesh::Mesh mesh_of(const FaultMesh& fault) {
  std::vector<IndexPoint> positions;
  for (const MeshVertex& v : fault.vertices) positions.push_back(v.position);
  std::vector<std::array<mesh::VertexId, 3>> faces;
  for (const MeshFace& f : fault.faces) faces.push_back(f.vertices);
  return mesh::Mesh(positions, faces);
}

inline double length_of(const IndexPoint& a, const IndexPoint& b) {
  return std::sqrt((a.i - b.i) * (a.i - b.i) + (a.j - b.j) * (a.j - b.j) + (a.k - b.k) * (a.k - b.k));
}

// What every mesh must be, whatever the pillars.
inline void expect_sound(const FaultMesh& fault, const Options& options = {}) {
  ASSERT_FALSE(fault.faces.empty());
  const mesh::Mesh m = mesh_of(fault);
  EXPECT_TRUE(mesh::problems_of(m).empty()) << mesh::problems_of(m).front();
  EXPECT_EQ(m.vertex_count(), static_cast<int>(fault.vertices.size())) << "vertices of no face";
  const bool parts_told = std::any_of(fault.notes.begin(), fault.notes.end(), [](const std::string& note) {
    return note.find("separate parts") != note.npos;
  });
  EXPECT_EQ(mesh::components(m).size() > 1, parts_told);
  for (mesh::EdgeId e = 0; e < m.edge_limit(); ++e) {
    const auto& ends = m.edge(e).vertices;
    EXPECT_LE(length_of(m.position(ends[0]), m.position(ends[1])), options.max_edge * (1 + 1e-9));
  }
  std::set<std::tuple<MeshVertex::Kind, std::int64_t, std::int32_t>> vertex_ids;
  for (const MeshVertex& v : fault.vertices) EXPECT_TRUE(vertex_ids.insert({v.kind, v.owner, v.n}).second);
  std::set<std::pair<std::int64_t, std::int32_t>> face_ids;
  for (const MeshFace& f : fault.faces) {
    EXPECT_TRUE(face_ids.insert({f.panel, f.n}).second);
    const auto a = fault.chart.from_index(fault.vertices[f.vertices[0]].position);
    const auto b = fault.chart.from_index(fault.vertices[f.vertices[1]].position);
    const auto c = fault.chart.from_index(fault.vertices[f.vertices[2]].position);
    EXPECT_GT((b.strike - a.strike) * (c.dip - a.dip) - (b.dip - a.dip) * (c.strike - a.strike), 0)
        << "turned over";
  }
  EXPECT_FALSE(cuts_itself(fault, false));
}

// Every node that was given is a vertex, to the last bit.
inline void expect_nodes_kept(const FaultMesh& fault, const std::vector<PillarInput>& pillars) {
  std::map<std::int64_t, IndexPoint> by_id;
  for (const MeshVertex& v : fault.vertices)
    if (v.node_id >= 0) by_id[v.node_id] = v.position;
  for (const PillarInput& p : pillars)
    for (std::size_t n = 0; n < p.nodes.size(); ++n)
      EXPECT_EQ(by_id.at(p.node_ids[n]), p.nodes[n]) << p.node_ids[n];
}

}  // namespace footwall::pillars::testing
