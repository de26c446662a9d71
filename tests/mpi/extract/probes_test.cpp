#include "engine/extract/probes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "engine/extract/exchange/exchange.h"
#include "engine/verify/contrast_by_definition.h"
#include "mpi/extract/same_bits.h"
#include "mpi/extract/survey_case.h"

namespace footwall::extract {
namespace {

std::map<std::int64_t, std::vector<Face>> by_fault(const Case& c) {
  std::map<std::int64_t, std::vector<Face>> all;
  for (const Face& face : c.faces) all[face.fault].push_back(face);
  return all;
}

// Layers that jump along a plane, with nulls; faces of three faults, large and small, inside and outside,
// with and without area. The same on every rank.
Case made_case(const survey::Index& dims, int faces, unsigned seed) {
  std::mt19937_64 random(seed);
  Case c{dims, {}, {}, 0};
  for (std::int64_t i = 0; i < dims[0]; ++i) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t k = 0; k < dims[2]; ++k) {
        const std::int64_t layer = i + j / 3 < 14 ? k : k + 5;
        float value = static_cast<float>((layer * 7919) % 13 - 6) + static_cast<float>(random() % 64) / 64;
        c.max_abs = std::max(c.max_abs, static_cast<double>(std::abs(value)));
        if (random() % 40 == 0) value = kNull;
        c.values.push_back(value);
      }
    }
  }
  const auto coordinate = [&](std::size_t axis, std::int64_t beyond) {
    const std::int64_t span = (dims[axis] + 2 * beyond) * 256;
    return static_cast<std::int32_t>(static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(span)) -
                                     beyond * 256 - 128);
  };
  for (int n = 0; n < faces; ++n) {
    Face face{7 + n % 3, 100 + n / 3, n, {}};
    const std::int64_t beyond = n % 4 == 0 ? 6 : 0;
    for (survey::LatticePoint& p : face.triangle)
      p = {coordinate(0, beyond), coordinate(1, beyond), coordinate(2, beyond)};
    if (n % 13 == 5) face.triangle[2] = face.triangle[1];
    if (n % 17 == 6) face.triangle = {face.triangle[0], face.triangle[0], face.triangle[0]};
    if (n % 5 == 2) face.triangle[1].i = face.triangle[2].i = face.triangle[0].i;  // a normal along an axis
    if (n % 29 == 8) {
      for (survey::LatticePoint& p : face.triangle) p.i += 1 << 24;
    }
    c.faces.push_back(face);
  }
  return c;
}

class Probes : public testing::TestWithParam<std::string_view> {
 protected:
  void check(const Case& c, int threads) {
    const comm::Communicator world(MPI_COMM_WORLD);
    Options options;
    options.exchange = GetParam();
    options.threads = threads;
    options.compute = {"contrast", "offset"};
    const Result result = extract_all(world, c.input(), options, c.reader());
    options.compute = {"contrast"};
    const Result contrast_alone = extract_all(world, c.input(), options, c.reader());
    if (world.rank() != 0) return;
    const auto faults = by_fault(c);
    int defined = 0;
    int away = 0;
    for (std::size_t n = 0; n < c.faces.size(); ++n) {
      SCOPED_TRACE(testing::Message() << "face " << n);
      const auto want = verify::contrast_by_definition(
          c.faces[n].triangle, c.dims, [&](const survey::Index& p) { return c.at(p); }, c.max_abs,
          verify::side_by_definition(faults.at(c.faces[n].fault)));
      EXPECT_EQ(bits(result.faces[n].contrast), bits(want.contrast));
      EXPECT_EQ(bits(result.faces[n].offset_voxels), bits(want.offset_voxels));
      EXPECT_EQ(bits(result.faces[n].offset_score), bits(want.offset_score));
      EXPECT_EQ(bits(contrast_alone.faces[n].contrast), bits(want.contrast));
      EXPECT_TRUE(std::isnan(contrast_alone.faces[n].offset_voxels));
      EXPECT_EQ(contrast_alone.faces[n].count, result.faces[n].count);
      defined += std::isnan(want.contrast) ? 0 : 1;
      away += want.offset_voxels != 0 && !std::isnan(want.offset_voxels) ? 1 : 0;
    }
    if (c.faces.size() > 30) {
      EXPECT_GT(defined, 10);  // or nothing was compared
      EXPECT_GT(away, 10);
    }
  }
};

TEST_P(Probes, AreTheDefinition) {
  check(made_case({26, 22, 30}, 36, 1), 1);
}
TEST_P(Probes, AreTheDefinitionWithThreads) {
  check(made_case({26, 22, 30}, 32, 2), 3);
}
TEST_P(Probes, HaveNoPlaceInTinySurveys) {
  check(made_case({1, 1, 1}, 12, 3), 1);
  check(made_case({40, 1, 20}, 20, 4), 1);
}

std::vector<std::string_view> built_strategies() {
  std::vector<std::string_view> names;
  for (const ExchangeStrategy& strategy : exchange_strategies()) {
    if (strategy.run != nullptr) names.push_back(strategy.name);
  }
  return names;
}
INSTANTIATE_TEST_SUITE_P(Strategies, Probes, testing::ValuesIn(built_strategies()),
                         [](const auto& chosen) { return std::string(chosen.param); });

TEST(ProbeNumbers, OffsetsAreCountedFromTheFaultsSideWhateverTheWinding) {
  const comm::Communicator world(MPI_COMM_WORLD);
  Case c = made_case({26, 22, 30}, 0, 5);
  const auto at = [](int i, int j, int k) { return survey::LatticePoint{256 * i, 256 * j, 256 * k}; };
  c.faces = {{1, 1, 0, {at(8, 2, 4), at(8, 14, 4), at(8, 2, 24)}}};
  Options options;
  options.compute = {"offset"};
  const Result one = extract_all(world, c.input(), options, c.reader());
  std::swap(c.faces[0].triangle[0], c.faces[0].triangle[1]);
  const Result turned = extract_all(world, c.input(), options, c.reader());
  if (world.rank() != 0) return;
  EXPECT_GT(one.faces[0].offset_voxels, 0);  // the jump lies at larger inlines
  EXPECT_EQ(one.faces[0].offset_voxels, turned.faces[0].offset_voxels);
}

TEST(ProbeNumbers, AFaceAtTheLatticesEndHasNone) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max() - 100;
  const survey::LatticeTriangle t{{{kFar, 0, 0}, {kFar, 5000, 0}, {kFar, 0, 5000}}};
  EXPECT_FALSE(shifted(t, 1).has_value());
  EXPECT_TRUE(shifted(t, -1).has_value());
}

class WholeFaults : public testing::TestWithParam<int> {};

TEST_P(WholeFaults, CountEachVoxelOnce) {
  const comm::Communicator world(MPI_COMM_WORLD);
  for (const survey::Index dims : {survey::Index{26, 22, 30}, {1, 1, 1}, {3, 40, 2}}) {
    const Case c = made_case(dims, 40, 6);
    Options options;
    options.threads = GetParam();
    LoadedSurvey survey(world, c.dims, c.reader(), {}, {GetParam(), 1});
    const std::vector<FaultStatistics> got = survey.faults(c.input(), options);
    if (world.rank() != 0) {
      EXPECT_TRUE(got.empty());
      continue;
    }
    const auto faults = by_fault(c);
    ASSERT_EQ(got.size(), faults.size());
    std::size_t n = 0;
    for (const auto& [fault, faces] : faults) {
      std::vector<survey::Index> voxels;
      for (const Face& face : faces) {
        const auto own = verify::voxels_in_survey(face.triangle, c.dims);
        voxels.insert(voxels.end(), own.begin(), own.end());
      }
      const std::size_t with_doubles = voxels.size();
      std::sort(voxels.begin(), voxels.end());
      voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
      EXPECT_LT(voxels.size(), with_doubles);
      const FaceStatistics want = verify::statistics_by_definition(
          voxels, c.dims, [&](const survey::Index& p) { return c.at(p); }, c.max_abs, Outside::kPartly);
      const FaultStatistics& have = got[n++];
      EXPECT_EQ(have.fault, fault);
      EXPECT_EQ(have.faces, static_cast<std::int64_t>(faces.size()));
      expect_equal(have.statistics, want);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(ThreadsAndPillars, WholeFaults, testing::Values(1, 3));

}  // namespace
}  // namespace footwall::extract
