#include "engine/synthetic/detail/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "unit/synthetic/small_survey.h"

namespace footwall::synthetic {
namespace {

using survey::IndexPoint;

class Truth : public testing::TestWithParam<std::uint64_t> {
 protected:
  static constexpr std::int64_t kSize = 112;
  static Options options() {
    Options options;
    options.size = {kSize, kSize, kSize};
    options.seed = GetParam();
    options.signal_to_noise = 3;
    return options;
  }
  const FaultedSurvey survey_{options()};
};

IndexPoint minus(const IndexPoint& a, const IndexPoint& b) {
  return {a.i - b.i, a.j - b.j, a.k - b.k};
}
double dot(const IndexPoint& a, const IndexPoint& b) {
  return a.i * b.i + a.j * b.j + a.k * b.k;
}
IndexPoint along(const IndexPoint& a, const IndexPoint& n, double t) {
  return {a.i + t * n.i, a.j + t * n.j, a.k + t * n.k};
}
IndexPoint normal_of(const IndexPoint& a, const IndexPoint& b, const IndexPoint& c) {
  const IndexPoint u = minus(b, a);
  const IndexPoint v = minus(c, a);
  const IndexPoint n{u.j * v.k - u.k * v.j, u.k * v.i - u.i * v.k, u.i * v.j - u.j * v.i};
  const double length = std::sqrt(dot(n, n));
  return {n.i / length, n.j / length, n.k / length};
}

// Distance from a point to a triangle by brute force over a fine grid of its points: slow, obvious, never too
// small.
double distance_to(const IndexPoint& p, const std::array<IndexPoint, 3>& triangle) {
  constexpr int kSteps = 24;
  double nearest = 1e300;
  for (int a = 0; a <= kSteps; ++a) {
    for (int b = 0; a + b <= kSteps; ++b) {
      const double s = static_cast<double>(a) / kSteps;
      const double t = static_cast<double>(b) / kSteps;
      const IndexPoint q =
          along(along(triangle[0], minus(triangle[1], triangle[0]), s), minus(triangle[2], triangle[0]), t);
      const IndexPoint off = minus(p, q);
      nearest = std::min(nearest, dot(off, off));
    }
  }
  return std::sqrt(nearest);
}

std::vector<IndexPoint> index_vertices(const FaultedSurvey& survey, const Fault& fault) {
  std::vector<IndexPoint> points;
  for (const survey::WorldPoint& p : fault.truth.vertices) points.push_back(survey.geometry().index_of(p));
  return points;
}

int pieces_of(const survey::Surface& surface) {
  std::vector<int> root(surface.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v];
    return v;
  };
  int pieces = static_cast<int>(root.size());
  for (const auto& [a, b, c] : surface.triangles) {
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}}) {
      const int from = find(p);
      const int to = find(q);
      if (from != to) --pieces;
      root[from] = to;
    }
  }
  return pieces;
}

TEST_P(Truth, IsAnOrientedManifoldInsideTheSurvey) {
  for (const Fault& fault : survey_.faults()) {
    std::map<std::pair<int, int>, int> sides;
    for (const auto& [a, b, c] : fault.truth.triangles) {
      ++sides[{a, b}];
      ++sides[{b, c}];
      ++sides[{c, a}];
    }
    // A side walked once in each direction at most: no edge has more than two triangles, and these agree.
    for (const auto& [side, count] : sides)
      ASSERT_EQ(count, 1) << fault.name << " " << side.first << " " << side.second;
    // A border that passes a vertex only once: no two fans that touch in a point.
    std::map<int, int> passes;
    for (const auto& [side, count] : sides) {
      if (!sides.contains({side.second, side.first})) ++passes[side.first];
    }
    for (const auto& [vertex, count] : passes) ASSERT_EQ(count, 1) << fault.name << " vertex " << vertex;
    // The listric fault lies wholly beyond the twisted one's tip line, and is cut in two.
    EXPECT_EQ(pieces_of(fault.truth), fault.name == "listric" ? 2 : 1) << fault.name;
    double longest = 0;
    const std::vector<IndexPoint> points = index_vertices(survey_, fault);
    for (const IndexPoint& p : points) {
      for (const double x : {p.i, p.j, p.k}) {
        ASSERT_GE(x, -1e-6) << fault.name;
        ASSERT_LE(x, kSize - 1 + 1e-6) << fault.name;
      }
    }
    for (const auto& [side, count] : sides) {
      const IndexPoint off = minus(points[side.first], points[side.second]);
      longest = std::max(longest, std::sqrt(dot(off, off)));
    }
    EXPECT_LT(longest, 18) << fault.name;
    EXPECT_GT(fault.truth.triangles.size(), 100U) << fault.name;
  }
}

// The definition: across the surface the layers do not continue. Exact, from the structure itself.
TEST_P(Truth, LayersJumpThere) {
  const detail::Structure structure(GetParam(), survey_.geometry().dims());
  for (const Fault& fault : survey_.faults()) {
    double least = 1e300;
    for (const IndexPoint& p : index_vertices(survey_, fault)) {
      const detail::Trace trace = structure.trace(p.i, p.j);
      const double above = trace.stratigraphic_depth(p.k - 0.5);
      const double below = trace.stratigraphic_depth(p.k + 0.5);
      least = std::min(least, below - above - trace.fold_scale);
    }
    EXPECT_GT(least, 0.5) << fault.name << ": the jump in samples, beyond the step of one sample";
  }
}

// The discontinuity of design section 6 over the voxels nearest to triangle centres, moved along the normals.
double discontinuity(const std::vector<float>& values, std::int64_t size,
                     const std::vector<IndexPoint>& points) {
  double num = 0;
  double den = 0;
  for (const IndexPoint& p : points) {
    const std::int64_t c[3] = {std::llround(p.i), std::llround(p.j), std::llround(p.k)};
    if (std::min({c[0], c[1], c[2]}) < 1 || std::max({c[0], c[1], c[2]}) > size - 2) continue;
    double sum = 0;
    for (std::int64_t i = c[0] - 1; i <= c[0] + 1; ++i) {
      for (std::int64_t j = c[1] - 1; j <= c[1] + 1; ++j) {
        const double value = values[static_cast<std::size_t>((i * size + j) * size + c[2])];
        sum += value;
        den += 9 * value * value;
      }
    }
    num += sum * sum;
  }
  return 1 - num / den;
}

TEST_P(Truth, IsWhereTheAmplitudesAreDiscontinuous) {
  const std::vector<float> values = all_of(survey_);
  for (const Fault& fault : survey_.faults()) {
    const std::vector<IndexPoint> vertices = index_vertices(survey_, fault);
    std::vector<IndexPoint> at;
    std::vector<IndexPoint> off;
    for (const auto& [a, b, c] : fault.truth.triangles) {
      const IndexPoint n = normal_of(vertices[a], vertices[b], vertices[c]);
      const IndexPoint centre = along(along(vertices[a], minus(vertices[b], vertices[a]), 1.0 / 3),
                                      minus(vertices[c], vertices[a]), 1.0 / 3);
      at.push_back(centre);
      off.push_back(along(centre, n, 6));
      off.push_back(along(centre, n, -6));
    }
    EXPECT_GT(discontinuity(values, kSize, at), 1.5 * discontinuity(values, kSize, off))
        << fault.name << " " << discontinuity(values, kSize, at) << " " << discontinuity(values, kSize, off);
  }
}

TEST_P(Truth, PillarsFollowItWithinTheJitter) {
  const Options given = options();
  double farthest = 0;
  for (const Fault& fault : survey_.faults()) {
    const std::vector<IndexPoint> vertices = index_vertices(survey_, fault);
    EXPECT_GE(fault.pillars.size(), 4U) << fault.name;
    double last_line = -1;
    for (const survey::Pillar& pillar : fault.pillars) {
      ASSERT_GE(pillar.nodes.size(), 2U);
      const IndexPoint first = survey_.geometry().index_of(pillar.nodes[0].position);
      const bool on_crosslines = fault.name == "twisted";
      const double line = on_crosslines ? first.j : first.i;
      EXPECT_NEAR(line, std::round(line / given.pillar_every_lines) * given.pillar_every_lines, 1e-6);
      EXPECT_GT(line, last_line);
      last_line = line;
      double last_depth = -1;
      for (const survey::PillarNode& node : pillar.nodes) {
        const IndexPoint p = survey_.geometry().index_of(node.position);
        EXPECT_NEAR(on_crosslines ? p.j : p.i, line, 1e-6) << "a pillar stays on its line";
        EXPECT_GT(p.k, last_depth);
        last_depth = p.k;
        double nearest = 1e300;
        for (const auto& [a, b, c] : fault.truth.triangles) {
          const IndexPoint off = minus(vertices[a], p);
          if (dot(off, off) > 20 * 20) continue;
          nearest = std::min(nearest, distance_to(p, {vertices[a], vertices[b], vertices[c]}));
        }
        // The triangles' chords and the fineness of the search allow a little more.
        EXPECT_LT(nearest, given.jitter_voxels + 0.4) << fault.name << " " << p.i << " " << p.j << " " << p.k;
        farthest = std::max(farthest, nearest);
      }
    }
  }
  EXPECT_GT(farthest, 0.5 * given.jitter_voxels) << "the jitter is there";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Truth, testing::Range<std::uint64_t>(1, 13));

// What the crossing does: on an inline that both blocks share, the listric fault's hanging part stands off
// the line that its footwall part would go on along.
TEST(TruthCrossing, TheYoungerFaultMovesTheOlder) {
  const survey::Index size{128, 128, 128};
  const detail::Structure structure(5, size);
  const detail::Sheet sheet = detail::true_sheet(structure, size, detail::FaultKind::kListric);
  int hanging = 0;
  int standing = 0;
  for (const IndexPoint& p : sheet.vertices) {
    const double side = p.i - structure.twisted_inline(p.j, p.k);
    const double off = p.j - structure.listric_crossline(p.i, p.k);
    const double thrown = structure.twisted_throw(p.i, p.j);
    // Off the cut and in the depth range where the listric fault's slope is no longer near zero.
    if (side < -1) {
      ++standing;
      EXPECT_NEAR(off, 0, 0.05);
    } else if (side > 1 && p.k > 64 && thrown > 3) {
      ++hanging;
      EXPECT_LT(off, -0.3) << "came down by " << thrown;
    }
  }
  EXPECT_GT(hanging, 20);
  EXPECT_GT(standing, 20);
}

}  // namespace
}  // namespace footwall::synthetic
