// Pictures of surfaces that are spread over ranks are those of one rank, however they are spread and grouped.
#include "engine/render/composite/compose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpi/exchange/profiled_calls.h"
#include "unit/render/sample_surfaces.h"

namespace footwall::render {
namespace {

constexpr int kWidth = 150;
constexpr int kHeight = 101;

struct Pixels {
  std::vector<float> depth;
  std::vector<Rgba> colours;
  friend bool operator==(const Pixels&, const Pixels&) = default;
};

Pixels pixels_of(const SurfaceLayer& layer) {
  const auto width = static_cast<std::size_t>(layer.width());
  Pixels pixels;
  pixels.depth.resize(width * static_cast<std::size_t>(layer.height()));
  pixels.colours.resize(pixels.depth.size());
  for (int y = 0; y < layer.height(); ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * width;
    layer.row(y, std::span(pixels.depth).subspan(first, width),
              std::span(pixels.colours).subspan(first, width));
  }
  return pixels;
}

// All of it on one rank, without any merging.
Pixels drawn_alone(std::span<const LitSurface> surfaces, const Camera& camera, int width, int height) {
  SurfaceFrame frame;
  VisibilityBuffer window(width, height);
  Pixels pixels;
  frame.project(surfaces, camera, width, height, 1);
  frame.rasterize(window, 1);
  pixels.colours.resize(window.pixels().size());
  frame.shade(window, pixels.colours, 1);
  for (const Visible pixel : window.pixels()) pixels.depth.push_back(depth_of(pixel));
  return pixels;
}

Camera camera_at(double azimuth) {
  return Camera::look(azimuth, 25, 1, Bounds{{-1, -1, -1}, {1, 1, 1}}, static_cast<double>(kWidth) / kHeight,
                      true);
}

struct Case {
  std::vector<OwnedSurface> whole;
  // Which rank has the n-th block of triangles.
  std::size_t block = 1;
  std::vector<int> rank_of_block;
};

std::vector<OwnedSurface> share_of(const Case& c, int rank) {
  std::vector<OwnedSurface> share;
  for (const OwnedSurface& mesh : c.whole) {
    OwnedSurface part = mesh;
    part.triangles.clear();
    part.runs.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::size_t block = t / c.block;
      if (c.rank_of_block[block % c.rank_of_block.size()] != rank) continue;
      if (part.runs.empty() || t % c.block == 0)
        part.runs.push_back(
            {part.triangles.size(), mesh.runs.front().first_id + static_cast<PrimitiveId>(t)});
      part.triangles.push_back(mesh.triangles[t]);
    }
    if (!part.triangles.empty()) share.push_back(std::move(part));
  }
  return share;
}

std::vector<LitSurface> views(const std::vector<OwnedSurface>& meshes) {
  std::vector<LitSurface> surfaces;
  for (const OwnedSurface& mesh : meshes) surfaces.push_back(mesh.view());
  return surfaces;
}

// Two balls of which one sticks out of the other, so that neighbours' pixels lie before and behind each
// other.
std::vector<OwnedSurface> two_balls(int around) {
  std::vector<OwnedSurface> meshes{sample::ball(around, 0), sample::ball(around, 1 << 20)};
  meshes[1].colour = hex(0x3080c0);
  meshes[1].placement.linear = {0.7, 0, 0, 0, 0, 0.7, 0, 0.7, 0};  // mirrored
  meshes[1].placement.shift = {0.3, -0.2, 0.1};
  return meshes;
}

void expect_one_ranks_picture(const Case& c, const Camera& camera, const std::string& what) {
  comm::Communicator world(MPI_COMM_WORLD);
  const Pixels want = drawn_alone(views(c.whole), camera, kWidth, kHeight);
  const std::vector<OwnedSurface> mine = share_of(c, world.rank());
  Composer composer;
  for (const double threshold : {-1.0, 0.0, 0.1, 10.0, 1e9}) {
    ComposeReport report;
    const SurfaceLayer layer =
        composer.compose(world, views(mine), camera, {kWidth, kHeight, 1, {threshold, 1 << 30}}, report);
    const Pixels got = pixels_of(layer);
    if (world.rank() == 0) {
      EXPECT_TRUE(got == want) << what << ", threshold " << threshold;
    } else {
      EXPECT_EQ(layer.bytes(), 0U);
    }
    if (threshold < 0 && world.size() > 1) {
      EXPECT_EQ(report.merged_bytes > 0, true);
    }
    if (threshold == 1e9) {
      EXPECT_EQ(report.merged_pixels, 0) << "everybody has everything";
    }
  }
}

TEST(Compose, IsThePictureOfOneRankHoweverTheTrianglesAreSpread) {
  const comm::Communicator world(MPI_COMM_WORLD);
  for (const std::size_t block : {1U, 50U, 3000U}) {
    Case c{two_balls(60), block, {}};
    for (int n = 0; n < 2 * world.size() + 1; ++n) c.rank_of_block.push_back((n * n + 1) % world.size());
    expect_one_ranks_picture(c, camera_at(35), "blocks of " + std::to_string(block));
  }
}

TEST(Compose, AllTrianglesMayBeOnOneRank) {
  const comm::Communicator world(MPI_COMM_WORLD);
  for (const int owner : {0, world.size() - 1, world.size() / 2}) {
    expect_one_ranks_picture({two_balls(40), 1, {owner}}, camera_at(200),
                             "all on rank " + std::to_string(owner));
  }
}

TEST(Compose, OneTriangleOrNoneIsAPicture) {
  const comm::Communicator world(MPI_COMM_WORLD);
  OwnedSurface one = sample::floor(1, 7);
  for (Vec3f& p : one.positions) p = {p.x / 100, p.y / 100, p.z};
  one.triangles.resize(1);
  for (int owner = 0; owner < world.size(); ++owner)
    expect_one_ranks_picture({{one}, 1, {owner}}, camera_at(10), "one on " + std::to_string(owner));
  comm::Communicator group(MPI_COMM_WORLD);
  Composer composer;
  ComposeReport report;
  const Pixels empty = pixels_of(composer.compose(group, {}, camera_at(0), {kWidth, kHeight, 1, {}}, report));
  EXPECT_EQ(std::count(empty.depth.begin(), empty.depth.end(), 1.0F), kWidth * kHeight);
}

TEST(Compose, NothingIsSeenBehindTheEye) {
  comm::Communicator world(MPI_COMM_WORLD);
  Case c{two_balls(40), 20, {}};
  for (int n = 0; n < world.size(); ++n) c.rank_of_block.push_back(n);
  const Camera away = Camera::look_at({0, 5, 0}, {0, 10, 0}, {0, 0, 1},
                                      std::array<Vec3, 2>{Vec3{-1, -1, -1}, Vec3{1, 1, 1}}, 1.5, true);
  const std::vector<OwnedSurface> mine = share_of(c, world.rank());
  Composer composer;
  ComposeReport report;
  const Pixels seen =
      pixels_of(composer.compose(world, views(mine), away, {kWidth, kHeight, 1, {-1, 0}}, report));
  EXPECT_EQ(std::count(seen.depth.begin(), seen.depth.end(), 1.0F), kWidth * kHeight);
  EXPECT_EQ(report.merged_pixels, 0);
}

// A rank that would have too much refuses, and then all further steps, while others go on.
TEST(Compose, GroupsMayHaveSeveralSizes) {
  comm::Communicator world(MPI_COMM_WORLD);
  Case c{two_balls(60), 30, {}};
  // The last rank has most.
  for (int n = 0; n < 3 * world.size(); ++n) c.rank_of_block.push_back(std::min(n, world.size() - 1));
  const std::vector<OwnedSurface> mine = share_of(c, world.rank());
  const Pixels want = drawn_alone(views(c.whole), camera_at(300), kWidth, kHeight);
  std::vector<std::int64_t> most_steps;
  for (const std::int64_t memory : {0, 100'000, 400'000, 700'000, 1 << 30}) {
    Composer composer;
    ComposeReport report;
    const Pixels got = pixels_of(
        composer.compose(world, views(mine), camera_at(300), {kWidth, kHeight, 1, {1e9, memory}}, report));
    if (world.rank() == 0) {
      EXPECT_TRUE(got == want) << memory << " bytes";
    }
    most_steps.push_back(world.maximum(std::int64_t{report.group_steps}));
  }
  EXPECT_TRUE(std::is_sorted(most_steps.begin(), most_steps.end()));
  EXPECT_EQ(most_steps.back(), Halving(world.size()).steps());
}

// Partners decide from numbers that both have: a rank without room is a refusal of both, and the others go
// on.
TEST(Compose, ARankWithoutRoomRefusesForItsPartner) {
  comm::Communicator world(MPI_COMM_WORLD);
  Case c{two_balls(60), 30, {}};
  for (int n = 0; n < 2 * world.size(); ++n) c.rank_of_block.push_back(n % world.size());
  const std::vector<OwnedSurface> mine = share_of(c, world.rank());
  const Pixels want = drawn_alone(views(c.whole), camera_at(300), kWidth, kHeight);
  for (int poor = 0; poor < world.size(); ++poor) {
    const std::int64_t memory = world.rank() == poor ? 0 : 1 << 30;
    Composer composer;
    ComposeReport report;
    const Pixels got = pixels_of(
        composer.compose(world, views(mine), camera_at(300), {kWidth, kHeight, 1, {1e9, memory}}, report));
    if (world.rank() == 0) {
      EXPECT_TRUE(got == want) << "rank " << poor << " has no room";
    }
    const Halving halving(world.size());
    int first_partner_step = 0;
    while (first_partner_step < halving.steps() && halving.partner(poor, first_partner_step) < 0)
      ++first_partner_step;
    if (world.rank() == poor && world.size() > 1) {
      EXPECT_EQ(report.group_steps, halving.gives(poor) ? 0 : first_partner_step);
    }
  }
}

// Nobody's rates change the picture, only who draws what.
TEST(Compose, EstimatedTimesDecideButDoNotChangeThePicture) {
  comm::Communicator world(MPI_COMM_WORLD);
  const Halving halving(world.size());
  for (const std::size_t block : {1U, 150U}) {
    Case c{two_balls(60), block, {}};
    for (int n = 0; n < world.size(); ++n) c.rank_of_block.push_back(n);
    const std::vector<OwnedSurface> mine = share_of(c, world.rank());
    const Pixels want = drawn_alone(views(c.whole), camera_at(70), kWidth, kHeight);
    const auto most_steps = [&](const GroupRates& rates) {
      Composer composer;
      ComposeReport report;
      const Pixels got = pixels_of(composer.compose(world, views(mine), camera_at(70),
                                                    {kWidth, kHeight, 1, {0.1, 1 << 30, rates}}, report));
      if (world.rank() == 0) {
        EXPECT_TRUE(got == want) << rates.triangle << " s a triangle";
      }
      return world.maximum(std::int64_t{report.group_steps});
    };
    // Pictures are dear and geometry costs nothing, and the other way round.
    EXPECT_EQ(most_steps({0, 0, 0, 0, 1e-6, 1e-6}), halving.steps());
    EXPECT_LE(most_steps({1e-6, 1e-6, 0, 0, 0, 0}), 1) << "what ranks without a partner skip";
    // Geometry that is worth some pictures and not others.
    for (const double triangle : {1e-9, 3e-9, 1e-8, 3e-8, 1e-7})
      most_steps({0, triangle, triangle, 1e-8, 1e-8, 1e-9});
    GroupRates measured = world.collectively([] { return measure_drawing(); });
    for (double GroupRates::*rate : kGroupRates) {
      EXPECT_TRUE(measured.*rate >= 0 && std::isfinite(measured.*rate));
      measured.*rate = world.maximum(measured.*rate);
    }
    EXPECT_GT(std::min({measured.geometry_byte, measured.triangle, measured.merged}), 0);
    most_steps(measured);
  }
}

TEST(CoveredPixels, AreAboutThoseThatASurfaceShows) {
  const std::vector<OwnedSurface> balls = two_balls(200);
  for (const double azimuth : {0.0, 70.0}) {
    for (const std::size_t count : {1U, 2U}) {
      const std::vector<LitSurface> all = views(balls);
      const std::span<const LitSurface> some(all.data(), count);
      const Pixels shown = drawn_alone(some, camera_at(azimuth), kWidth, kHeight);
      const auto seen =
          static_cast<double>(kWidth * kHeight - std::count(shown.depth.begin(), shown.depth.end(), 1.0F));
      const auto guess = static_cast<double>(covered_pixels(some, camera_at(azimuth), kWidth, kHeight));
      EXPECT_GT(guess, 0.7 * seen);
      EXPECT_LT(guess, 1.5 * seen) << "the back side and the second ball lie in the same rectangle";
    }
  }
  EXPECT_EQ(covered_pixels({}, camera_at(0), kWidth, kHeight), 0);
  // Larger than the picture, and behind the eye.
  const OwnedSurface floor = sample::floor(1, 0);
  const LitSurface one = floor.view();
  EXPECT_LE(covered_pixels(std::span(&one, 1), camera_at(0), kWidth, kHeight), kWidth * kHeight);
  const Camera away = Camera::look_at({0, 500, 0}, {0, 1000, 0}, {0, 0, 1},
                                      std::array<Vec3, 2>{Vec3{-1, -1, -1}, Vec3{1, 1, 1}}, 1.5, true);
  EXPECT_EQ(covered_pixels(std::span(&one, 1), away, kWidth, kHeight), 0);
}

TEST(Compose, LargePicturesAreMadeInBands) {
  comm::Communicator world(MPI_COMM_WORLD);
  Case c{{sample::ball(24, 0)}, 7, {}};
  for (int n = 0; n < world.size(); ++n) c.rank_of_block.push_back(n);
  constexpr int kWide = 9000;
  constexpr int kHigh = 2100;  // more than Composer::kMostPixels in all
  static_assert(std::int64_t{kWide} * kHigh > Composer::kMostPixels);
  const Camera camera =
      Camera::look(20, 10, 1, Bounds{{-1, -1, -1}, {1, 1, 1}}, static_cast<double>(kWide) / kHigh, false);
  const std::vector<OwnedSurface> mine = share_of(c, world.rank());
  Composer composer;
  ComposeReport report;
  const SurfaceLayer layer = composer.compose(world, views(mine), camera, {kWide, kHigh, 1, {-1, 0}}, report);
  if (world.rank() == 0) {
    EXPECT_TRUE(pixels_of(layer) == drawn_alone(views(c.whole), camera, kWide, kHigh));
  }
}

TEST(Compose, CountsWhatItGivesToMpi) {
  comm::Communicator world(MPI_COMM_WORLD);
  Case c{two_balls(60), 11, {}};
  for (int n = 0; n < world.size(); ++n) c.rank_of_block.push_back(n);
  const std::vector<OwnedSurface> mine = share_of(c, world.rank());
  for (const double threshold : {-1.0, 0.1, 1e9}) {
    Composer composer;
    ComposeReport report;
    const ProfiledCalls before = profiled_calls();
    composer.compose(world, views(mine), camera_at(35), {kWidth, kHeight, 1, {threshold, 1 << 30}}, report);
    const ProfiledCalls after = profiled_calls();
    EXPECT_EQ(report.bytes, after.bytes - before.bytes);
    EXPECT_EQ(report.messages, after.messages - before.messages);
    EXPECT_EQ(report.messages > 0, world.size() > 1);
  }
}

TEST(Compose, ASizeThatCannotBeIsRefusedEverywhere) {
  comm::Communicator world(MPI_COMM_WORLD);
  Composer composer;
  ComposeReport report;
  EXPECT_THROW(composer.compose(world, {}, camera_at(0), {0, 10, 1, {}}, report), comm::AgreedError);
  EXPECT_THROW(composer.compose(world, {}, camera_at(0), {10, 1 << 20, 1, {}}, report), comm::AgreedError);
}

// Who has which rows after the last step: every row once.
TEST(Halving, SharesAllRowsAmongTheCore) {
  for (int ranks = 1; ranks < 40; ++ranks) {
    const Halving halving(ranks);
    std::vector<int> owners(57);
    for (int rank = 0; rank < ranks; ++rank) {
      const Rows rows = halving.rows(rank, halving.steps(), {3, 60});
      for (int y = rows.begin; y < rows.end; ++y) ++owners[static_cast<std::size_t>(y - 3)];
      for (int step = 0; step < halving.steps(); ++step) {
        const int partner = halving.partner(rank, step);
        if (partner >= 0) {
          EXPECT_EQ(halving.partner(partner, step), rank);
        }
      }
    }
    EXPECT_EQ(std::count(owners.begin(), owners.end(), 1), 57) << ranks << " ranks";
  }
}

}  // namespace
}  // namespace footwall::render
