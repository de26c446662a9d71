// What is kept of faces' voxels: the same bytes on any number of ranks and threads and with every strategy
// that moves voxels, and, read back, the voxels of the volume.
#include "engine/extract/lot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/extract/exchange/exchange.h"
#include "engine/extract/extract.h"
#include "engine/voxelize/registry.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr survey::Index kDims{30, 26, 40};

float value_at(const survey::Index& p) {
  if ((p[0] * 31 + p[1] * 17 + p[2]) % 53 == 0) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>((p[0] * 7 + p[1] * 3 + (p[2] * p[2]) % 29) % 61) - 30;
}

void read(const survey::Box& box, std::span<float> out) {
  std::size_t n = 0;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) out[n++] = value_at({i, j, k});
    }
  }
}

std::vector<Face> faces() {
  std::mt19937 random(5);
  std::vector<Face> all;
  for (std::int32_t n = 0; n < 40; ++n) {
    Face face{1 + n % 2, 10, n, {}};
    for (survey::LatticePoint& p : face.triangle) {
      p = {static_cast<std::int32_t>(random() % 9000) - 700, static_cast<std::int32_t>(random() % 7600) - 500,
           static_cast<std::int32_t>(random() % 10500)};
    }
    if (n % 9 == 4) face.triangle[2] = face.triangle[1];
    if (n == 7) {
      for (survey::LatticePoint& p : face.triangle) p.i += 1 << 20;  // wholly outside
    }
    all.push_back(face);
  }
  return all;
}

Options options_for(const std::string& exchange, const std::string& voxelizer = "exact") {
  Options options;
  options.exchange = exchange;
  options.voxelizer = voxelizer;
  options.compute = {"variance", "voxels", "lot"};
  options.snr = 40;
  return options;
}

std::vector<std::string> moving_strategies() {
  std::vector<std::string> names{"auto"};
  for (const ExchangeStrategy& each : exchange_strategies()) {
    if (each.moves_voxels && each.run != nullptr) names.emplace_back(each.name);
  }
  return names;
}

TEST(LotMpi, TheSameBytesForEveryStrategyAndRankCountAndTheVoxelsInThem) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const std::vector<Face> all = faces();
  const Input input{kDims, 31, all};
  // By this rank alone.
  std::vector<FaceRows> rows(all.size());
  std::vector<std::vector<float>> values(all.size());
  FaceBlobs expected;
  const auto voxelizer = voxelize::make_voxelizer();
  const auto lot = make_lot(options_for("minimum"));
  for (std::size_t f = 0; f < all.size(); ++f) {
    voxelizer->rows(all[f].triangle, {{0, 0, 0}, kDims}, rows[f]);
    rows[f].for_each([&](const survey::Index& p) { values[f].push_back(value_at(p)); });
    lot->compute({all[f], rows[f], values[f]}, expected.bytes);
    expected.offsets.push_back(expected.bytes.size());
  }
  for (const std::string& exchange : moving_strategies()) {
    for (const int threads : {1, 3}) {
      Options options = options_for(exchange);
      options.threads = threads;
      const Result result = extract_all(world, input, options, read);
      EXPECT_NE(result.report.exchange, "reduce");
      if (world.rank() != 0) continue;
      ASSERT_EQ(result.blobs.size(), 2U);
      ASSERT_EQ(result.blobs[0].computation, "voxels");
      ASSERT_EQ(result.blobs[1].computation, "lot");
      EXPECT_EQ(result.blobs[1].bytes, expected.bytes) << exchange;
      ASSERT_EQ(result.blobs[1].offsets.size(), all.size() + 1);
      VoxelReader reader("voxels");
      std::vector<float> back;
      for (std::size_t f = 0; f < all.size(); ++f) {
        EXPECT_EQ(result.blobs[1].offsets[f + 1], expected.offsets[f]);
        reader.read(result.blobs[0].of(f), rows[f], back);
        ASSERT_EQ(back.size(), values[f].size());
        for (std::size_t n = 0; n < back.size(); ++n) {
          EXPECT_TRUE(back[n] == values[f][n] || (std::isnan(back[n]) && std::isnan(values[f][n])));
        }
      }
    }
  }
}

TEST(LotMpi, AStrategyThatMovesNoVoxelsIsRefused) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const std::vector<Face> all = faces();
  try {
    extract_all(world, {kDims, 31, all}, options_for("reduce"), read);
    FAIL() << "reduce has no voxels to give";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
    EXPECT_NE(error.hint().find("push"), std::string::npos);
  }
}

}  // namespace
}  // namespace footwall::extract
