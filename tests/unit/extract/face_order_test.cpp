#include "engine/extract/face_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace footwall::extract {
namespace {

Face face_at(std::int32_t i, std::int32_t j, std::int32_t k) {
  Face face;
  face.triangle = {{{i, j, k}, {i + 300, j, k}, {i, j + 300, k + 100}}};
  return face;
}

// 16 x 16 x 16 faces in an order that jumps about.
std::vector<Face> scattered() {
  std::vector<Face> faces;
  for (int n = 0; n < 4096; ++n) {
    const int at = n * 2731 % 4096;
    faces.push_back(face_at(2560 * (at / 256), 2560 * (at / 16 % 16), 2560 * (at % 16)));
  }
  return faces;
}

double way(const std::vector<Face>& faces, const std::vector<std::int64_t>& order) {
  double sum = 0;
  for (std::size_t n = 1; n < order.size(); ++n) {
    const auto& a = faces[static_cast<std::size_t>(order[n - 1])].triangle[0];
    const auto& b = faces[static_cast<std::size_t>(order[n])].triangle[0];
    sum += std::abs(a.i - b.i) + std::abs(a.j - b.j) + std::abs(a.k - b.k);
  }
  return sum;
}

TEST(FaceOrder, IsAPermutationThatGoesFromNeighbourToNeighbour) {
  const std::vector<Face> faces = scattered();
  std::vector<std::int64_t> order = ordered_by_place(faces);
  // Morton's curve jumps every other step, and farther now and then: less than two cells on average.
  EXPECT_LT(way(faces, order), 2.0 * 2560 * 4095);
  std::sort(order.begin(), order.end());
  std::vector<std::int64_t> all(faces.size());
  std::iota(all.begin(), all.end(), std::int64_t{0});
  EXPECT_EQ(order, all);
}

TEST(FaceOrder, TakesThoseThatAreListed) {
  const std::vector<Face> faces = scattered();
  const std::vector<std::int64_t> which = {7, 4000, 12, 100};
  std::vector<std::int64_t> order = ordered_by_place(faces, which);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::vector<std::int64_t>{7, 12, 100, 4000}));
  EXPECT_TRUE(ordered_by_place(faces, {}).empty());
  EXPECT_TRUE(ordered_by_place({}).empty());
}

TEST(FaceOrder, TiesStayInOrderAndTheLatticesEndsFit) {
  const std::int32_t most = std::numeric_limits<std::int32_t>::max() - 300;
  const std::int32_t least = std::numeric_limits<std::int32_t>::min();
  const std::vector<Face> faces = {face_at(most, most, most), face_at(least, least, least),
                                   face_at(most, most, most), face_at(least, least, least)};
  EXPECT_EQ(ordered_by_place(faces), (std::vector<std::int64_t>{1, 3, 0, 2}));
}

}  // namespace
}  // namespace footwall::extract
