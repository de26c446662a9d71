#include "storage/formats/raw.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::raw {
namespace {

float value_at(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<float>(100 * i + 10 * j + k);
}

std::string bytes_of(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

// The file by its definition: three nested loops from the slowest to the fastest axis.
std::string volume_in_order(const survey::Index& dims, const AxisOrder& order) {
  std::vector<float> values;
  survey::Index p{};
  for (p[order[0]] = 0; p[order[0]] < dims[order[0]]; ++p[order[0]]) {
    for (p[order[1]] = 0; p[order[1]] < dims[order[1]]; ++p[order[1]]) {
      for (p[order[2]] = 0; p[order[2]] < dims[order[2]]; ++p[order[2]])
        values.push_back(value_at(p[0], p[1], p[2]));
    }
  }
  return bytes_of(values);
}

TEST(Raw, ReadsAnyBlockInAnyAxisOrder) {
  const ScratchFolder folder;
  const survey::Index dims{4, 5, 9};
  for (const char* name : {"ijk", "ikj", "jik", "jki", "kij", "kji"}) {
    const AxisOrder order = axis_order_from(name);
    const RawFile file(folder.file("v.raw", volume_in_order(dims, order)), dims, order);
    for (const survey::Box& box : {survey::Box{{0, 0, 0}, dims}, survey::Box{{1, 2, 3}, {3, 4, 5}},
                                   survey::Box{{3, 4, 8}, {4, 5, 9}}, survey::Box{{0, 1, 0}, {4, 5, 1}}}) {
      std::vector<float> values(static_cast<std::size_t>(box.count()));
      file.read_block(box, values);
      std::size_t n = 0;
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
            ASSERT_EQ(values[n++], value_at(i, j, k)) << name;
        }
      }
    }
  }
}

TEST(Raw, RefusesOtherSizesAndOrders) {
  const ScratchFolder folder;
  const auto path = folder.file("v.raw", std::string(4 * 24, '\0'));
  EXPECT_NO_THROW(RawFile(path, {2, 3, 4}));
  try {
    const RawFile file(path, {2, 3, 5});
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFormat);
    EXPECT_NE(error.message().find("96"), std::string::npos);
    EXPECT_NE(error.message().find("120"), std::string::npos);
  }
  EXPECT_THROW(RawFile(path, {0, 3, 4}), Error);
  EXPECT_THROW(RawFile(path, {-2, -3, 4}), Error);
  EXPECT_THROW(RawFile(path, {std::int64_t{1} << 31, std::int64_t{1} << 31, 6}), Error);
  for (const char* bad : {"", "ij", "iij", "ijl", "IJK", "ijkk"})
    EXPECT_THROW(axis_order_from(bad), Error) << bad;
}

TEST(Raw, WritesWhatItReads) {
  const ScratchFolder folder;
  const survey::Index dims{5, 3, 4};
  const auto reader = [&](const survey::Box& box, std::span<float> values) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = value_at(i, j, k);
      }
    }
  };
  for (const std::int64_t lines : {1, 2, 99}) {
    write(folder / "out.raw", dims, reader, lines);
    EXPECT_EQ(content_of(folder / "out.raw"), volume_in_order(dims, kSampleFastest));
  }
}

TEST(Raw, WritesAnyAxisOrderAndByteOrder) {
  const ScratchFolder folder;
  const survey::Index dims{3, 4, 6};
  const auto reader = [&](const survey::Box& box, std::span<float> values) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = value_at(i, j, k);
      }
    }
  };
  for (const char* name : {"ijk", "ikj", "jik", "jki", "kij", "kji"}) {
    const AxisOrder order = axis_order_from(name);
    EXPECT_EQ(name_of(order), name);
    write(folder / "out.raw", dims, reader, 2, {}, {order, false});
    EXPECT_EQ(content_of(folder / "out.raw"), volume_in_order(dims, order)) << name;
    write(folder / "big.raw", dims, reader, 2, {}, {order, true});
    std::string swapped = content_of(folder / "big.raw");
    for (std::size_t n = 0; n < swapped.size(); n += 4)
      std::reverse(swapped.begin() + n, swapped.begin() + n + 4);
    EXPECT_EQ(swapped, volume_in_order(dims, order)) << name;
    std::vector<float> values(3 * 4 * 6);
    RawFile(folder / "big.raw", dims, order, true).read_block({{0, 0, 0}, dims}, values);
    EXPECT_EQ(bytes_of(values), volume_in_order(dims, kSampleFastest)) << name;
  }
}

TEST(Raw, NanBitsSurvive) {
  const ScratchFolder folder;
  const std::uint32_t payload = 0x7FC01234u;
  write(folder / "out.raw", {1, 1, 1},
        [&](const survey::Box&, std::span<float> values) { std::memcpy(values.data(), &payload, 4); });
  EXPECT_EQ(content_of(folder / "out.raw"), std::string("\x34\x12\xC0\x7F", 4));
}

TEST(Raw, AFailedOrCancelledExportLeavesNoFile) {
  const ScratchFolder folder;
  EXPECT_THROW(write(folder / "out.raw", {2, 2, 2},
                     [](const survey::Box&, std::span<float>) { throw Error(ErrorCode::kCorrupt, "chunk"); }),
               Error);
  const JobContext job;
  job.cancel();
  EXPECT_THROW(write(
                   folder / "out.raw", {2, 2, 2}, [](const survey::Box&, std::span<float>) {}, 1, job),
               Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace footwall::formats::raw
