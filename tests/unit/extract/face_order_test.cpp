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

std::vector<std::size_t> order_of(const std::vector<Face>& faces) {
  FaceOrder order;
  order.of(faces);
  std::vector<std::size_t> all(order.size());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = order[n];
  return all;
}

double way(const std::vector<Face>& faces, const std::vector<std::size_t>& order) {
  double sum = 0;
  for (std::size_t n = 1; n < order.size(); ++n) {
    const auto& a = faces[order[n - 1]].triangle[0];
    const auto& b = faces[order[n]].triangle[0];
    sum += std::abs(a.i - b.i) + std::abs(a.j - b.j) + std::abs(a.k - b.k);
  }
  return sum;
}

TEST(FaceOrder, IsAPermutationThatGoesFromNeighbourToNeighbour) {
  const std::vector<Face> faces = scattered();
  std::vector<std::size_t> order = order_of(faces);
  // Morton's curve jumps every other step, and farther now and then: less than two cells on average.
  EXPECT_LT(way(faces, order), 2.0 * 2560 * 4095);
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> all(faces.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(order, all);
}

TEST(FaceOrder, FewFacesStayAsTheyAre) {
  EXPECT_TRUE(order_of({}).empty());
  EXPECT_EQ(order_of({face_at(2560, 0, 0), face_at(0, 0, 0), face_at(2560, 0, 0)}),
            (std::vector<std::size_t>{0, 1, 2}));
}

TEST(FaceOrder, TakesOtherFacesAfterwards) {
  FaceOrder order;
  order.of(scattered());
  order.of(std::vector<Face>{face_at(0, 0, 0)});
  ASSERT_EQ(order.size(), 1u);
  EXPECT_EQ(order[0], 0u);
}

TEST(FaceOrder, TiesStayInOrderAndTheLatticesEndsFit) {
  const std::int32_t most = std::numeric_limits<std::int32_t>::max() - 300;
  const std::int32_t least = std::numeric_limits<std::int32_t>::min();
  std::vector<Face> faces;
  for (std::size_t n = 0; n < FaceOrder::kFewFaces; ++n)
    faces.push_back(n % 2 == 0 ? face_at(most, most, most) : face_at(least, least, least));
  const std::vector<std::size_t> order = order_of(faces);
  for (std::size_t n = 0; n < order.size(); ++n)
    EXPECT_EQ(order[n], n < order.size() / 2 ? 2 * n + 1 : 2 * n - order.size()) << n;
}

TEST(FaceOrder, FacesInOnePlaceStayInOrder) {
  const std::vector<Face> faces(1000, face_at(5, 6, 7));
  std::vector<std::size_t> all(faces.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(order_of(faces), all);
}

}  // namespace
}  // namespace footwall::extract
