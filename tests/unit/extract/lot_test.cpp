#include "engine/extract/lot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/voxelize/exact.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

const survey::LatticeTriangle kTriangle{
    survey::LatticePoint{-700, 300, 100}, {5000, 900, 12600}, {4800, 9000, 9000}};
const survey::Box kBox{{0, 0, 0}, {40, 40, 60}};

struct Shaped {
  FaceRows rows;
  std::vector<float> values;
};

Shaped shaped() {
  Shaped made;
  voxelize::ExactScratch scratch;
  voxelize::exact_rows(kTriangle, kBox, scratch, made.rows);
  made.rows.for_each([&](const survey::Index& p) {
    made.values.push_back(static_cast<float>(5 * std::sin(static_cast<double>(p[2]) / 2) +
                                             0.1 * static_cast<double>(p[1] % 7)));
  });
  made.values[5] = std::numeric_limits<float>::infinity();
  return made;
}

std::vector<std::byte> computed(WholeFace& computation, const Shaped& face) {
  std::vector<std::byte> out;
  const Face named{1, 2, 3, kTriangle};
  computation.compute({named, face.rows, face.values}, out);
  return out;
}

Options with(double snr, const std::string& order) {
  Options options;
  options.snr = snr;
  options.lot_order = order;
  return options;
}

TEST(Lot, EveryOrderComesBackWithinItsRatio) {
  const Shaped face = shaped();
  for (const std::string order : {"2d", "2d=tuned", "1d", "1d=zero", "1d=tuned", "1d=zero,tuned"}) {
    const auto lot = make_lot(with(40, order));
    const std::vector<std::byte> bytes = computed(*lot, face);
    EXPECT_LT(bytes.size(), face.values.size() * 2) << order;
    VoxelReader reader("lot");
    std::vector<float> back;
    for (int round = 0; round < 2; ++round) reader.read(bytes, face.rows, back);
    ASSERT_EQ(back.size(), face.values.size());
    double worst = 0;
    for (std::size_t n = 0; n < back.size(); ++n) {
      ASSERT_EQ(std::isnan(back[n]), n == 5);
      if (n != 5) worst = std::max(worst, static_cast<double>(std::abs(back[n] - face.values[n])));
    }
    EXPECT_LT(worst, 0.25) << order;
    EXPECT_EQ(computed(*lot, face), bytes) << "a second face of the same thread";
  }
}

TEST(Lot, VoxelsComeBackAsTheyWere) {
  const Shaped face = shaped();
  const auto voxels = make_voxels({});
  const std::vector<std::byte> bytes = computed(*voxels, face);
  VoxelReader reader("voxels");
  std::vector<float> back;
  reader.read(bytes, face.rows, back);
  for (std::size_t n = 0; n < back.size(); ++n) {
    if (n == 5) {
      EXPECT_TRUE(std::isnan(back[n]));
    } else {
      EXPECT_EQ(back[n], face.values[n]);
    }
  }
  EXPECT_THROW(reader.read(std::span(bytes).first(bytes.size() - 4), face.rows, back), Error);
}

TEST(Lot, WithoutARatioNothingIsKept) {
  const Shaped face = shaped();
  EXPECT_TRUE(computed(*make_lot(with(0, "1d")), face).empty());
  EXPECT_TRUE(computed(*make_lot(with(0, "2d")), Shaped{}).empty());
}

TEST(Lot, WhatCannotBeIsRefused) {
  EXPECT_THROW(make_lot(with(30, "3d")), Error);
  EXPECT_THROW(make_lot(with(30, "2d=zero")), Error);
  EXPECT_THROW(make_lot(with(30, "1d=loud")), Error);
  EXPECT_THROW(make_lot(with(-1, "2d")), Error);
  EXPECT_THROW(make_lot(with(300, "2d")), Error);
  EXPECT_THROW(VoxelReader("mean"), Error);
}

TEST(Lot, RowsInNoLatticeAreALine) {
  FaceRows rows;
  const std::vector<std::int32_t> lo{3, 4};
  const std::vector<std::int32_t> hi{5, 4};
  rows.row({2, 1, 0, 10, 8, lo, hi});
  rows.row({2, 1, 0, 10, 7, lo, hi});  // backwards
  lapped::Columns columns;
  columns_of(rows, columns);
  EXPECT_EQ(columns.voxels, 8);
  EXPECT_EQ(columns.lengths.size(), 1U);
  rows.clear();
  rows.row({2, 1, 0, 10, 7, lo, hi});
  rows.row({2, 1, 0, 12, 7, lo, hi});
  columns_of(rows, columns);
  EXPECT_EQ(columns.lengths, (std::vector<std::int32_t>{3, 1, 3, 1}));
  EXPECT_EQ(columns.rows.size(), 1U);
}

}  // namespace
}  // namespace footwall::extract
