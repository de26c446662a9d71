#include "engine/pillars/triangulate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "engine/mesh/walk.h"
#include "rounds.h"
#include "storage/base/error.h"
#include "unit/pillars/sound_mesh.h"
#include "unit/pillars/true_surface.h"

namespace footwall::pillars {
namespace {

using survey::IndexPoint;
using namespace testing;

std::array<double, 3> area_vector(const FaultMesh& m) {
  std::array<double, 3> sum{0, 0, 0};
  for (const MeshFace& f : m.faces) {
    const auto &a = m.vertices[f.vertices[0]].position, &b = m.vertices[f.vertices[1]].position,
               &c = m.vertices[f.vertices[2]].position;
    const double u[3]{b.i - a.i, b.j - a.j, b.k - a.k}, v[3]{c.i - a.i, c.j - a.j, c.k - a.k};
    for (int k = 0; k < 3; ++k)
      sum[k] += 0.5 * (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
  }
  return sum;
}

// The mesh's height over a chart position, by looking at every face; NaN outside.
double mesh_height(const FaultMesh& m, double x, double y) {
  for (const MeshFace& f : m.faces) {
    ChartPoint p[3];
    for (int k = 0; k < 3; ++k) p[k] = m.chart.from_index(m.vertices[f.vertices[k]].position);
    double w[3];
    for (int k = 0; k < 3; ++k) {
      const ChartPoint &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
      w[k] = (b.strike - a.strike) * (y - a.dip) - (b.dip - a.dip) * (x - a.strike);
    }
    const double sum = w[0] + w[1] + w[2], least = std::min({w[0], w[1], w[2]});
    if (least < -1e-9 * sum) continue;
    return (w[0] * p[0].height + w[1] * p[1].height + w[2] * p[2].height) / sum;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// A point at normalised length of a polyline, the obvious way.
IndexPoint along(const std::vector<IndexPoint>& nodes, double s) {
  double total = 0;
  for (std::size_t n = 1; n < nodes.size(); ++n) total += length_of(nodes[n - 1], nodes[n]);
  double left = s * total;
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const double length = length_of(nodes[n - 1], nodes[n]);
    if (left <= length || n + 1 == nodes.size()) {
      const double t = length > 0 ? std::min(1.0, left / length) : 0;
      const IndexPoint &a = nodes[n - 1], &b = nodes[n];
      return {a.i + t * (b.i - a.i), a.j + t * (b.j - a.j), a.k + t * (b.k - a.k)};
    }
    left -= length;
  }
  return nodes[0];
}

// The largest height difference between the mesh and the ruled surface of two neighbours, sampled densely.
double worst_error(const FaultMesh& m, const PillarInput& a, const PillarInput& b, int steps) {
  double worst = 0;
  for (int r = 1; r < 2 * steps; ++r) {
    const IndexPoint p = along(a.nodes, 0.5 * r / steps), q = along(b.nodes, 0.5 * r / steps);
    for (int c = 1; c < steps; ++c) {
      const double t = double(c) / steps;
      const ChartPoint at =
          m.chart.from_index({p.i + t * (q.i - p.i), p.j + t * (q.j - p.j), p.k + t * (q.k - p.k)});
      const double height = mesh_height(m, at.strike, at.dip);
      EXPECT_TRUE(std::isfinite(height)) << "a hole";
      worst = std::max(worst, std::abs(height - at.height));
    }
  }
  return worst;
}

TEST(Triangulate, KnownSurfacesGiveSoundMeshesThroughEveryNode) {
  for (const Surface& surface : {Surface(planar), Surface(listric), Surface(twisted)}) {
    for (double jitter : {0.0, 1.5}) {
      const auto pillars = picked(surface, 9, 11, 12, jitter);
      const FaultMesh m = woven(pillars);
      expect_sound(m);
      expect_nodes_kept(m, pillars);
      EXPECT_EQ(m.panels.size(), 8u);
      EXPECT_EQ(mesh::boundary_loops(mesh_of(m)).size(), 1u);
      EXPECT_FALSE(cuts_itself(m, true));
      EXPECT_GT(area_vector(m)[0], 0);
    }
  }
}

TEST(Triangulate, StaysWithinDetailOfTheRuledSurface) {
  for (double detail : {0.5, 0.1}) {
    auto pillars = picked(twisted, 3, 7, 40, 1.0);
    for (auto& node : pillars[1].nodes) node.i += 6;  // bends both panels
    const Options options{.detail = detail, .max_edge = 30};
    const FaultMesh m = woven(pillars, options);
    expect_sound(m, options);
    for (int p = 0; p < 2; ++p) EXPECT_LE(worst_error(m, pillars[p], pillars[p + 1], 40), detail);
  }
}

TEST(Triangulate, RefinesOnlyWhereItBends) {
  const Options coarse{.detail = 0.5, .max_edge = 200};
  EXPECT_EQ(woven(picked(planar, 2, 2, 50), coarse).faces.size(), 2u);
  const std::vector<PillarInput> saddle{{1, "a", {{0, 0, 0}, {0, 0, 100}}, {}},
                                        {2, "b", {{0, 60, 0}, {30, 60, 100}}, {}}};
  const auto bent = woven(saddle, coarse).faces.size();
  EXPECT_GT(bent, 20u);
  EXPECT_GT(woven(saddle, {.detail = 0.1, .max_edge = 200}).faces.size(), 2 * bent);
}

TEST(Triangulate, MovingANodeChangesItsPanelsAlone) {
  auto pillars = picked(twisted, 8, 9, 12, 1.0);
  const FaultMesh before = woven(pillars);
  pillars[3].nodes[4].i += 3;
  pillars[3].nodes[4].k += 1;
  const FaultMesh after = woven(pillars, {}, before.chart);
  const std::set<std::int64_t> touched{pair_id(3, 4), pair_id(4, 5)};
  using VertexKey = std::tuple<MeshVertex::Kind, std::int64_t, std::int32_t>;
  auto faces = [&](const FaultMesh& m) {
    std::map<std::pair<std::int64_t, std::int32_t>,
             std::array<std::pair<VertexKey, std::array<double, 3>>, 3>>
        out;
    for (const MeshFace& f : m.faces) {
      if (touched.contains(f.panel)) continue;
      auto& corners = out[{f.panel, f.n}];
      for (int k = 0; k < 3; ++k) {
        const MeshVertex& v = m.vertices[f.vertices[k]];
        corners[k] = {{v.kind, v.owner, v.n}, {v.position.i, v.position.j, v.position.k}};
      }
    }
    return out;
  };
  EXPECT_EQ(faces(before), faces(after));
  EXPECT_GT(faces(before).size(), 100u);
  EXPECT_EQ(after.chart, before.chart);
  expect_sound(after);
}

TEST(Triangulate, MeanNormalHasAPositiveFirstComponentAtFirst) {
  // Faults almost along the inline axis, where the fitted plane and the mean normal may disagree about the
  // sign.
  int turned = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    auto pillars = picked([](double, double) { return 50; }, 5, 5, 12, 4.0, seed);
    for (auto& p : pillars)
      for (auto& n : p.nodes) std::swap(n.i, n.j);
    const FaultMesh m = woven(pillars);
    expect_sound(m);
    EXPECT_GT(area_vector(m)[0], 0);
    turned += m.chart.normal[0] < 0;
    const FaultMesh again = woven(pillars, {}, m.chart);
    ASSERT_EQ(again.faces.size(), m.faces.size());
    for (std::size_t f = 0; f < m.faces.size(); ++f) EXPECT_EQ(again.faces[f].vertices, m.faces[f].vertices);
  }
  EXPECT_GT(turned, 0) << "the case is not exercised";
}

TEST(Triangulate, NetworkFollowsTheTrueSurface) {
  std::vector<PillarInput> pillars = picked(listric, 6, 10, 20);
  for (int n = 0; n < 4; ++n) pillars.push_back(slice(listric, 11 + n, 14 + 22 * n, 2, 118, 12));
  const FaultMesh m = woven(pillars, {.max_edge = 60});
  expect_sound(m, {.max_edge = 60});
  double worst = 0;
  for (double j = 12; j < 108; j += 3.7) {
    for (double k = 15; k < 79; k += 2.9) {
      const ChartPoint at = m.chart.from_index({listric(j, k), j, k});
      worst = std::max(worst, std::abs(mesh_height(m, at.strike, at.dip) - at.height));
    }
  }
  EXPECT_LT(worst, 1.0) << "the nodes themselves are 10 voxels apart on a curve";
}

TEST(Triangulate, OrderAndDirectionOfPickingLeaveNoTrace) {
  auto pillars = picked(listric, 9, 8, 11, 1.0);
  const FaultMesh straight = woven(pillars);
  std::mt19937 random(5);
  std::shuffle(pillars.begin(), pillars.end(), random);
  for (std::size_t n = 0; n < pillars.size(); n += 2) {
    std::reverse(pillars[n].nodes.begin(), pillars[n].nodes.end());
    std::reverse(pillars[n].node_ids.begin(), pillars[n].node_ids.end());
  }
  const FaultMesh shuffled = woven(pillars, {}, straight.chart);
  ASSERT_EQ(shuffled.vertices.size(), straight.vertices.size());
  for (std::size_t v = 0; v < straight.vertices.size(); ++v) {
    EXPECT_EQ(shuffled.vertices[v].position, straight.vertices[v].position);
    EXPECT_EQ(shuffled.vertices[v].node_id, straight.vertices[v].node_id);
  }
  for (std::size_t f = 0; f < straight.faces.size(); ++f)
    EXPECT_EQ(shuffled.faces[f].vertices, straight.faces[f].vertices);
  EXPECT_EQ(shuffled.notes.size(), straight.notes.size() + 5) << "reversed pillars are told";
}

TEST(Triangulate, TimeSlicesAlone) {
  std::vector<PillarInput> pillars;
  for (int n = 0; n < 6; ++n) pillars.push_back(slice(listric, 20 - n, 10 + 15 * n, 5, 120, 9));
  const FaultMesh m = woven(pillars);
  expect_sound(m);
  expect_nodes_kept(m, pillars);
  EXPECT_EQ(m.panels.size(), 5u);
}

TEST(Triangulate, InlinesAlone) {
  auto pillars = picked(planar, 6, 8, 13, 0.5);
  for (auto& p : pillars)
    for (auto& n : p.nodes) std::swap(n.i, n.j);  // j = surface(i, k)
  const FaultMesh m = woven(pillars);
  expect_sound(m);
  EXPECT_EQ(m.panels.size(), 5u);
  EXPECT_GT(area_vector(m)[0], 0);
}

TEST(Triangulate, NetworkIsTiedHalfWay) {
  auto pillars = picked(listric, 5, 9, 20);
  for (int n = 0; n < 3; ++n) pillars.push_back(slice(listric, 11 + n, 25 + 25 * n, 2, 98, 13, 1.0));
  const FaultMesh m = woven(pillars);
  expect_sound(m);
  EXPECT_FALSE(cuts_itself(m, true));
  EXPECT_EQ(m.mis_ties.size(), 15u);
  for (const MisTie& tie : m.mis_ties) {
    EXPECT_GT(tie.distance, 0.2);
    EXPECT_LT(tie.distance, 1.5);
    EXPECT_LT(tie.pillar_a, tie.pillar_b);
    const auto at = std::find_if(m.vertices.begin(), m.vertices.end(),
                                 [&](const MeshVertex& v) { return v.position == tie.position; });
    EXPECT_NE(at, m.vertices.end());
  }
  EXPECT_EQ(m.panels.size(), 4u * 2 + 4 * 2 + 2 * 2 + 4) << "cells, top and bottom, sides, corners";
}

TEST(Triangulate, MovingANodeOfANetworkChangesItsPanelsAlone) {
  auto pillars = picked(listric, 6, 9, 20);
  for (int n = 0; n < 3; ++n) pillars.push_back(slice(listric, 11 + n, 20.3 + 25 * n, 2, 118, 13, 0.5));
  const FaultMesh before = woven(pillars);
  pillars[2].nodes[4].i += 1;
  const FaultMesh after = woven(pillars, {}, before.chart);
  using Corner = std::array<double, 3>;
  auto faces = [](const FaultMesh& m) {
    std::set<std::int64_t> touched;
    for (const Panel& p : m.panels)
      if (std::find(p.pillars.begin(), p.pillars.end(), 3) != p.pillars.end()) touched.insert(p.id);
    std::map<std::pair<std::int64_t, std::int32_t>, std::array<Corner, 3>> out;
    for (const MeshFace& f : m.faces) {
      if (touched.contains(f.panel)) continue;
      for (int k = 0; k < 3; ++k) {
        const auto& p = m.vertices[f.vertices[k]].position;
        out[{f.panel, f.n}][k] = {p.i, p.j, p.k};
      }
    }
    return out;
  };
  EXPECT_EQ(faces(before), faces(after));
  EXPECT_GT(faces(before).size(), 100u);
  EXPECT_LT(faces(before).size(), before.faces.size());
}

TEST(Triangulate, TwoPillarsThatCrossAreFilledAllRound) {
  const std::vector<PillarInput> pillars{{1, "down", {{0.5, 50, 10}, {0.5, 50, 90}}, {}},
                                         {2, "level", {{0, 10, 50}, {0, 90, 50}}, {}}};
  const FaultMesh m = woven(pillars);
  expect_sound(m);
  ASSERT_EQ(m.mis_ties.size(), 1u);
  EXPECT_NEAR(m.mis_ties[0].distance, 0.5, 1e-3);
  EXPECT_EQ(m.panels.size(), 4u);
}

TEST(Triangulate, SingleNodesMakeFansAndInnerPoints) {
  auto pillars = picked(planar, 5, 6, 20);
  for (int p : {0, 2}) {
    pillars[p].nodes = {pillars[p].nodes[2]};
    pillars[p].node_ids = {pillars[p].node_ids[2]};
  }
  const FaultMesh m = woven(pillars);
  expect_sound(m);
  expect_nodes_kept(m, pillars);
  EXPECT_EQ(m.panels.size(), 3u);
}

TEST(Triangulate, DuplicateNodesAreLeftOutAndTold) {
  auto pillars = picked(planar, 3, 5, 20);
  const FaultMesh clean = woven(pillars);
  auto& p = pillars[1];
  p.nodes.insert(p.nodes.begin() + 2, p.nodes[2]);
  p.node_ids.insert(p.node_ids.begin() + 3, 77);
  const FaultMesh m = woven(pillars, {}, clean.chart);
  expect_sound(m);
  EXPECT_EQ(m.faces.size(), clean.faces.size());
  EXPECT_EQ(m.notes.size(), 1u);
}

TEST(Triangulate, SharedTip) {
  std::vector<PillarInput> pillars{{1, "a", {{0, 0, 0}, {0, 20, 60}}, {}},
                                   {2, "b", {{0, 40, 0}, {0, 20, 60}}, {}}};
  expect_sound(woven(pillars));
}

TEST(Triangulate, RandomPillarsGiveASoundMeshOrAnError) {
  std::mt19937 random(11);
  auto uniform = [&](double a, double b) { return a + (b - a) * double(random()) / double(random.max()); };
  int woven_count = 0;
  for (int round = 0; round < rounds(150); ++round) {
    std::vector<PillarInput> pillars;
    const int count = 2 + static_cast<int>(random() % 6);
    for (int p = 0; p < count; ++p) {
      PillarInput pillar{p + 1, fmt::format("R{}", p + 1), {}, {}};
      const bool level = random() % 4 == 0;
      const int nodes = 1 + static_cast<int>(random() % 6);
      const double at = uniform(0, 60);
      for (int n = 0; n < nodes; ++n) {
        const double wander = uniform(-3, 3), run = 60.0 * n / std::max(1, nodes - 1) + uniform(-4, 4);
        pillar.nodes.push_back({uniform(-0.5, 0.5), level ? run : at + wander, level ? at + wander : run});
      }
      pillars.push_back(pillar);
    }
    try {
      const FaultMesh m = woven(pillars);
      expect_sound(m);
      ++woven_count;
    } catch (const Error& e) {
      EXPECT_NE(e.code(), ErrorCode::kInternal) << e.what();
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(woven_count, 40);
}

TEST(Triangulate, WeavesAHundredThousandTriangles) {
  const FaultMesh m = woven(picked(listric, 100, 20, 12, 1.0), {.detail = 0.5, .max_edge = 2.2});
  EXPECT_GT(m.faces.size(), 80000u);
}

// A fault picked on four inlines ten apart, long down the section: one node that sticks out by more than the
// lines are apart turns the least-squares plane of the nodes into the section, where the pillars lie on one
// another.
TEST(Triangulate, NarrowFaultWithANodeFarOutKeepsASurface) {
  std::vector<PillarInput> pillars;
  for (int p = 0; p < 4; ++p) {
    PillarInput pillar{p + 1, fmt::format("P{}", p + 1), {}, {}};
    for (int n = 0; n < 5; ++n)
      pillar.nodes.push_back({128.0 + 10 * p, 188.0 + 3 * (p % 2) + 9 * n + n * n, 20.0 + 50 * n});
    pillars.push_back(pillar);
  }
  const FaultMesh before = woven(pillars);
  expect_sound(before);
  pillars[3].nodes[2].j -= 60;
  expect_sound(woven(pillars));
  const FaultMesh after = woven(pillars, {}, before.chart);
  expect_sound(after);
  const auto [i, j, k] = after.chart.normal;
  EXPECT_GT(std::abs(j), std::abs(i)) << "the frame is that of the section";
  // Nor does a frame that was found when there were other pillars stay in the way.
  const Chart section = fit_chart(std::span(pillars).first(1));
  expect_sound(woven(pillars, {}, section));
}

// One node typed with too many digits: thousands of points in two rows, in a panel and in a cell.
TEST(Triangulate, ANodeFarBelowTheOthersGivesASoundMesh) {
  const auto wall = [](double j, double) { return 60 + 0.3 * j; };
  auto wedge = picked(wall, 2, 3, 20);
  wedge[1].nodes[2].k = 80000;
  const FaultMesh long_panel = woven(wedge);
  EXPECT_GT(long_panel.vertices.size(), 10000u);
  expect_sound(long_panel);
  auto spike = picked(wall, 2, 3, 20);
  spike[0].nodes = {{60, 10, 2}, {60, 10, 80000}, {61, 12, 10}};
  const FaultMesh folded = woven(spike);
  EXPECT_GT(folded.vertices.size(), 9000u);
  expect_sound(folded);
}

TEST(Triangulate, CanBeCancelled) {
  const JobContext job;
  job.cancel();
  EXPECT_THROW(triangulate(picked(planar, 9, 9, 9), {}, std::nullopt, job), Error);
}

}  // namespace
}  // namespace footwall::pillars
