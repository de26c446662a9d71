#include "engine/extract/extract.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <tuple>

#include "engine/extract/balance/none.h"
#include "engine/verify/statistics_by_definition.h"
#include "engine/verify/voxel_oracle.h"

namespace footwall::extract {
namespace {

constexpr float kNull = std::numeric_limits<float>::quiet_NaN();

struct Case {
  survey::Index dims;
  std::vector<float> values;
  std::vector<Face> faces;
  double max_abs = 0;

  float at(const survey::Index& p) const {
    return values[static_cast<std::size_t>((p[0] * dims[1] + p[1]) * dims[2] + p[2])];
  }
  Input input() const { return {dims, max_abs, faces}; }
  ReadBox reader() const {
    return [this](const survey::Box& box, std::span<float> out) {
      ASSERT_EQ(static_cast<std::int64_t>(out.size()), box.count());
      std::size_t n = 0;
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) out[n++] = at({i, j, k});
        }
      }
    };
  }
};

// The same on every rank: the generator's numbers are the standard's, the rest is integer arithmetic.
Case random_case(const survey::Index& dims, int faces, unsigned seed) {
  std::mt19937_64 random(seed);
  Case made{dims, {}, {}, 0};
  for (std::int64_t n = 0; n < dims[0] * dims[1] * dims[2]; ++n) {
    const auto whole = static_cast<std::int32_t>(random() % 2000001) - 1000000;
    float value = static_cast<float>(whole) * 0.0009765625F;
    if (random() % 23 == 0) value *= 1e-30F;
    made.max_abs = std::max(made.max_abs, static_cast<double>(std::abs(value)));
    if (random() % 19 == 0) value = kNull;
    made.values.push_back(value);
  }
  const auto coordinate = [&](std::size_t axis, std::int64_t beyond) {
    const std::int64_t span = (dims[axis] + 2 * beyond) * 256;
    return static_cast<std::int32_t>(static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(span)) -
                                     beyond * 256 - 128);
  };
  for (int n = 0; n < faces; ++n) {
    Face face{7 + n % 3, 100 + n / 3, n, {}};
    const std::int64_t beyond = n % 4 == 0 ? 6 : n % 11 == 3 ? 40 : 0;
    for (survey::LatticePoint& p : face.triangle)
      p = {coordinate(0, beyond), coordinate(1, beyond), coordinate(2, beyond)};
    if (n % 13 == 5) face.triangle[2] = face.triangle[1];                                     // a segment
    if (n % 17 == 6) face.triangle = {face.triangle[0], face.triangle[0], face.triangle[0]};  // a point
    if (n % 5 == 2) {  // on voxel centres and cube faces
      for (survey::LatticePoint& p : face.triangle) p = {p.i / 128 * 128, p.j / 128 * 128, p.k / 256 * 256};
    }
    if (n % 29 == 8) {  // far away
      for (survey::LatticePoint& p : face.triangle) p.i += 1 << 24;
    }
    made.faces.push_back(face);
  }
  return made;
}

survey::Box bounding_box(const survey::LatticeTriangle& t, const survey::Index& dims) {
  survey::Box box{{1 << 30, 1 << 30, 1 << 30}, {-(1 << 30), -(1 << 30), -(1 << 30)}};
  for (const survey::LatticePoint& p : t) {
    const survey::Index at{p.i, p.j, p.k};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], (at[axis] >> 8) - 1);
      box.hi[axis] = std::max(box.hi[axis], (at[axis] >> 8) + 3);
    }
  }
  return survey::intersection(box, {{0, 0, 0}, dims});
}

Outside where(const survey::LatticeTriangle& t, const survey::Index& dims, bool touched) {
  if (!touched) return Outside::kWholly;
  for (const survey::LatticePoint& p : t) {
    const double at[3] = {p.i / 256.0, p.j / 256.0, p.k / 256.0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < -0.5 || at[axis] > static_cast<double>(dims[axis]) - 0.5) return Outside::kPartly;
    }
  }
  return Outside::kInside;
}

std::vector<FaceStatistics> by_definition(const Case& c) {
  std::vector<FaceStatistics> all;
  for (const Face& face : c.faces) {
    const survey::Box box = bounding_box(face.triangle, c.dims);
    const auto voxels =
        box.empty() ? std::vector<survey::Index>{} : verify::voxels_by_definition(face.triangle, box);
    all.push_back(verify::statistics_by_definition(
        voxels, c.dims, [&](const survey::Index& p) { return c.at(p); }, c.max_abs,
        where(face.triangle, c.dims, !voxels.empty())));
  }
  return all;
}

std::uint64_t bits(double value) {
  return std::isnan(value) ? 1 : std::bit_cast<std::uint64_t>(value);
}

void expect_equal(const std::vector<FaceStatistics>& got, const std::vector<FaceStatistics>& want) {
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t n = 0; n < got.size(); ++n) {
    SCOPED_TRACE(testing::Message() << "face " << n);
    EXPECT_EQ(got[n].count, want[n].count);
    EXPECT_EQ(got[n].nulls, want[n].nulls);
    EXPECT_EQ(got[n].outside, want[n].outside);
    EXPECT_EQ(bits(got[n].mean), bits(want[n].mean));
    EXPECT_EQ(bits(got[n].variance), bits(want[n].variance));
    EXPECT_EQ(bits(got[n].min), bits(want[n].min));
    EXPECT_EQ(bits(got[n].max), bits(want[n].max));
    EXPECT_EQ(bits(got[n].discontinuity), bits(want[n].discontinuity));
  }
}

class ExtractAll : public testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Options options() const {
    Options options;
    options.exchange = std::get<0>(GetParam());
    options.threads = std::get<1>(GetParam());
    return options;
  }
  // Checks every number on rank 0 and the report on all.
  void check(const Case& c) {
    const comm::Communicator world(MPI_COMM_WORLD);
    const Result result = extract_all(world, c.input(), options(), c.reader());
    EXPECT_EQ(result.report.exchange, options().exchange);
    EXPECT_EQ(result.report.ranks, world.size());
    EXPECT_GE(result.report.load_max_over_mean, 1 - 1e-12);
    if (world.rank() != 0) {
      EXPECT_TRUE(result.faces.empty());
      return;
    }
    const std::vector<FaceStatistics> truth = by_definition(c);
    expect_equal(result.faces, truth);
    EXPECT_EQ(result.report.checksum, checksum_of(c.faces, truth));
    std::int64_t voxels = 0;
    for (const FaceStatistics& face : truth) voxels += face.count + face.nulls;
    EXPECT_EQ(result.report.voxels, voxels);
    if (world.size() == 1) {
      EXPECT_EQ(result.report.bytes_sent, 0);
      EXPECT_EQ(result.report.messages, 0);
    }
  }
};

TEST_P(ExtractAll, IsTheDefinitionOnRandomFaces) {
  check(random_case({21, 17, 33}, 150, 1));
}
TEST_P(ExtractAll, WorksWithOneVoxel) {
  check(random_case({1, 1, 1}, 30, 2));
}
TEST_P(ExtractAll, WorksWithFewerTracesThanRanks) {
  check(random_case({2, 1, 40}, 40, 3));
}
TEST_P(ExtractAll, WorksWithAFlatSurvey) {
  check(random_case({30, 40, 1}, 40, 4));
}
TEST_P(ExtractAll, WorksWithMoreInlinesThanASlab) {
  check(random_case({150, 5, 9}, 30, 5));
}
TEST_P(ExtractAll, WorksWithoutFaces) {
  check(random_case({5, 5, 5}, 0, 6));
}
TEST_P(ExtractAll, WorksWithNothingButNulls) {
  Case c = random_case({6, 6, 6}, 20, 7);
  std::fill(c.values.begin(), c.values.end(), kNull);
  c.max_abs = 0;
  check(c);
}

TEST_P(ExtractAll, LeavesOutWhatIsNotAskedFor) {
  const Case c = random_case({9, 9, 9}, 20, 8);
  const comm::Communicator world(MPI_COMM_WORLD);
  Options wanted = options();
  wanted.compute = {"variance"};
  const Result result = extract_all(world, c.input(), wanted, c.reader());
  std::vector<FaceStatistics> truth = by_definition(c);
  for (FaceStatistics& face : truth) face.discontinuity = kUndefined;
  if (world.rank() == 0) expect_equal(result.faces, truth);
}

INSTANTIATE_TEST_SUITE_P(StrategiesAndThreads, ExtractAll,
                         testing::Combine(testing::Values("reduce", "minimum", "block=2", "block=5",
                                                          "bounding", "push"),
                                          testing::Values(1, 3)),
                         [](const auto& chosen) {
                           std::string name = std::get<0>(chosen.param);
                           std::replace(name.begin(), name.end(), '=', '_');
                           return name + "_threads_" + std::to_string(std::get<1>(chosen.param));
                         });

ErrorCode code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(ExtractErrors, OneRanksTroubleEndsTheJobOnAll) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Case c = random_case({12, 12, 8}, 20, 9);
  const bool last = world.rank() == world.size() - 1;

  // Cancelled on one rank only.
  const JobContext job;
  if (last) job.cancel();
  EXPECT_EQ(code_of([&] { extract_all(world, c.input(), {}, c.reader(), job); }), ErrorCode::kCancelled);

  // One rank's values exceed the recorded maximum.
  Input input = c.input();
  if (world.rank() == 0) input.max_abs = c.max_abs * 1e-9;
  EXPECT_EQ(code_of([&] { extract_all(world, input, {}, c.reader()); }), ErrorCode::kCorrupt);
}

TEST(ExtractErrors, WrongNamesAreWrongUsageOnAllRanks) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Case c = random_case({4, 4, 4}, 2, 10);
  std::vector<Options> wrong(6);
  wrong[0].exchange = "block=0";
  wrong[1].exchange = "guess";
  wrong[2].balance = "manhattan";
  wrong[3].voxelizer = "gpu";
  wrong[4].compute = {"lot"};
  wrong[5].threads = 0;
  for (const Options& options : wrong) {
    EXPECT_EQ(code_of([&] { extract_all(world, c.input(), options, c.reader()); }), ErrorCode::kUsage);
  }
}

TEST(Centroid, IsRoundedToEvenAndClamped) {
  const survey::Index dims{10, 10, 10};
  const auto at = [](int i, int j, int k) { return survey::LatticePoint{i, j, k}; };
  // Sums of 384 = half of 3 x 256, and 1152 = one and a half.
  EXPECT_EQ(centroid_voxel({at(384, 1152, 0), at(0, 0, 0), at(0, 0, 0)}, dims), (survey::Index{0, 2, 0}));
  EXPECT_EQ(centroid_voxel({at(-5000, 99999, 385), at(0, 0, 0), at(0, 0, 0)}, dims),
            (survey::Index{0, 9, 1}));
}

}  // namespace
}  // namespace footwall::extract
