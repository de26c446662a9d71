#include "engine/extract/cache/brick_owners.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace footwall::extract {
namespace {

bool in(const MaskProduct& product, const survey::Index& voxel) {
  return (product.word(static_cast<std::size_t>(voxel[0] & 7)) >> (8 * (voxel[1] & 7) + (voxel[2] & 7)) &
          1) != 0;
}

TEST(BrickOwners, SayWhatTheGridSays) {
  for (const survey::Index dims : {survey::Index{43, 38, 9}, {5, 90, 1}, {1, 1, 1}, {64, 17, 3}}) {
    for (const std::array<int, 2> pillars : {std::array<int, 2>{1, 1}, std::array<int, 2>{3, 2}}) {
      for (const int ranks : {1, 2, 7, 12}) {
        const comm::RankGrid grid(dims, ranks, pillars);
        const BrickOwners owners(grid);
        for (std::int64_t i = 0; i < dims[0]; ++i) {
          for (std::int64_t j = 0; j < dims[1]; ++j) {
            const survey::Index voxel{i, j, dims[2] - 1};
            const std::array<std::int32_t, 3> brick{static_cast<std::int32_t>(i >> 3),
                                                    static_cast<std::int32_t>(j >> 3), 0};
            for (int rank = 0; rank < ranks; ++rank) {
              const std::vector<survey::Box> boxes = grid.boxes(rank);
              const auto any = [&](std::int64_t reach) {
                return std::any_of(boxes.begin(), boxes.end(), [&](const survey::Box& box) {
                  return survey::grown(box, reach).contains(voxel);
                });
              };
              EXPECT_EQ(in(owners.owned(rank, brick), voxel), any(0));
              EXPECT_EQ(in(owners.held(rank, brick), voxel), any(1));
            }
            int seen = 0;
            owners.for_each_owner(brick, [&](int owner, const MaskProduct& product) {
              if (!in(product, voxel)) return;
              ++seen;
              EXPECT_EQ(owner, grid.owner(voxel));
            });
            EXPECT_EQ(seen, 1);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace footwall::extract
