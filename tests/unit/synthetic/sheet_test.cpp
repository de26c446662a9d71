#include "engine/synthetic/detail/sheet.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace footwall::synthetic::detail {
namespace {

using survey::IndexPoint;

// A flat square of side 4 in the plane k = 0.
Sheet square() {
  return grid_sheet(4, 4, [](int a, int b) {
    return IndexPoint{static_cast<double>(a), static_cast<double>(b), 0};
  });
}

double area(const Sheet& sheet) {
  double sum = 0;
  for (const auto& [a, b, c] : sheet.triangles) {
    const IndexPoint& p = sheet.vertices[a];
    const IndexPoint& q = sheet.vertices[b];
    const IndexPoint& r = sheet.vertices[c];
    sum += ((q.i - p.i) * (r.j - p.j) - (q.j - p.j) * (r.i - p.i)) / 2;
  }
  return sum;
}

TEST(Sheet, ClippingKeepsExactlyTheInside) {
  EXPECT_DOUBLE_EQ(area(square()), 16);
  const auto slanted = [](const IndexPoint& p) { return p.i + 0.5 * p.j - 1.7; };
  const Sheet kept = clipped(square(), slanted);
  for (const IndexPoint& p : kept.vertices) EXPECT_GE(slanted(p), -1e-12);
  EXPECT_NEAR(area(kept), 16 - 1.7 * 3.4 / 2, 1e-12) << "signed: also shows that the winding stayed";
}

TEST(Sheet, CutsThroughVerticesLeaveNoEmptyTriangles) {
  const Sheet kept = clipped(square(), [](const IndexPoint& p) { return p.i - p.j; });
  EXPECT_DOUBLE_EQ(area(kept), 8);
  EXPECT_EQ(kept.triangles.size(), 16U);
  EXPECT_EQ(kept.vertices.size(), 15U) << "those of the other half are gone";
  EXPECT_TRUE(clipped(square(), [](const IndexPoint& p) { return -1 - p.i; }).triangles.empty());
}

TEST(Sheet, TheTwoSidesOfACutFitTogether) {
  const auto value = [](const IndexPoint& p) { return p.i * p.i / 3 + p.j - 2.1; };
  const Sheet left = clipped(square(), value);
  const Sheet right = clipped(square(), [&](const IndexPoint& p) { return -value(p); });
  const Sheet whole = joined(left, right);
  EXPECT_NEAR(area(whole), 16, 1e-12);
  // Sides walked once form the border; along the cut every side has a triangle on both hands.
  std::set<std::pair<int, int>> sides;
  for (const auto& [p, q, r] : whole.triangles) sides.insert({{p, q}, {q, r}, {r, p}});
  for (const auto& [p, q] : sides) {
    if (sides.contains({q, p})) continue;
    const IndexPoint& from = whole.vertices[p];
    const IndexPoint& to = whole.vertices[q];
    const auto on_rim = [](double x, double y) { return x == y && (x == 0 || x == 4); };
    EXPECT_TRUE(on_rim(from.i, to.i) || on_rim(from.j, to.j)) << from.i << " " << from.j;
  }
}

}  // namespace
}  // namespace footwall::synthetic::detail
