#include "storage/formats/face_arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "scratch_folder.h"

namespace footwall::formats::face_arrays {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Value>
std::vector<Value> values_in(const std::string& bytes, const Array& array) {
  std::size_t count = 1;
  for (const std::int64_t n : array.shape) count *= static_cast<std::size_t>(n);
  std::vector<Value> values(count);
  EXPECT_LE(static_cast<std::size_t>(array.offset) + count * sizeof(Value), bytes.size());
  std::memcpy(values.data(), bytes.data() + array.offset, count * sizeof(Value));
  return values;
}

TEST(FaceArrays, StandWhereTheListSays) {
  MeshTable a;
  a.fault = "A";
  a.vertices = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  a.triangles = {{0, 1, 2}};
  a.face_ids = {"3-7.12"};
  a.statistics = {{"mean", {2.5}}};
  MeshTable b = a;
  b.fault = "B";
  b.vertices.push_back({5, 6, 7});
  b.triangles = {{0, 1, 3}, {2, 1, 0}};
  b.face_ids = {"1.0", "1.1"};
  b.statistics = {{"throw", {1, kNaN}}};
  const ScratchFolder folder;
  const auto arrays = write(folder / "arrays", std::vector<MeshTable>{a, b});
  const std::string bytes = content_of(folder / "arrays");

  ASSERT_EQ(arrays.size(), 6u);
  for (const Array& array : arrays) EXPECT_EQ(array.offset % 8, 0);
  EXPECT_EQ(arrays[0].name, "vertices");
  EXPECT_EQ(arrays[0].shape, (std::vector<std::int64_t>{7, 3}));
  EXPECT_EQ(values_in<double>(bytes, arrays[0])[20], 7);
  EXPECT_EQ(values_in<std::int32_t>(bytes, arrays[1]),
            (std::vector<std::int32_t>{0, 1, 2, 3, 4, 6, 5, 4, 3}));
  EXPECT_EQ(values_in<std::int32_t>(bytes, arrays[2]), (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(arrays[3].type, "|S6");
  EXPECT_EQ(bytes.substr(static_cast<std::size_t>(arrays[3].offset), 18), std::string("3-7.12"
                                                                                      "1.0\0\0\0"
                                                                                      "1.1\0\0\0",
                                                                                      18));
  EXPECT_EQ(arrays[4].name, "statistic:mean");
  EXPECT_EQ(values_in<double>(bytes, arrays[4])[0], 2.5);
  EXPECT_TRUE(std::isnan(values_in<double>(bytes, arrays[4])[1]));
  EXPECT_EQ(arrays[5].name, "statistic:throw");
  EXPECT_EQ(values_in<double>(bytes, arrays[5])[1], 1);
}

}  // namespace
}  // namespace footwall::formats::face_arrays
