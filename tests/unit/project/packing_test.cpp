#include "storage/project/detail/packing.h"

#include <gtest/gtest.h>

#include <limits>

#include "unit/project/project_folder.h"

namespace footwall::project::detail {
namespace {

TEST(Packing, ArraysComeBackOneAfterTheOther) {
  Bytes bytes = packed(std::vector<double>{1.5, -0.0, 1e300});
  append(bytes, std::span<const std::int32_t>(std::vector<std::int32_t>{7, -8}));
  std::span<const std::byte> rest(bytes);
  EXPECT_EQ(taken<double>(rest, 3), (std::vector<double>{1.5, -0.0, 1e300}));
  EXPECT_EQ(taken<std::int32_t>(rest, 2), (std::vector<std::int32_t>{7, -8}));
  EXPECT_TRUE(rest.empty());
  EXPECT_THROW(taken<std::int32_t>(rest, 1), Error);
}

TEST(Packing, SizesAreComparedWithoutOverflow) {
  EXPECT_NO_THROW(require_size("x", 24, 3, 8));
  EXPECT_NO_THROW(require_size("x", 0, 0, 8));
  EXPECT_THROW(require_size("x", 24, -3, 8), Error);
  EXPECT_THROW(require_size("x", 25, 3, 8), Error);
  EXPECT_THROW(require_size("x", 0, std::int64_t{1} << 61, 8), Error);
}

TEST(Packing, CompressedBytesComeBackAndLiesAboutTheirSizeDoNot) {
  const Bytes bytes(100'000, std::byte{42});
  const Bytes small = compressed(bytes);
  EXPECT_LT(small.size(), 1000U);
  EXPECT_EQ(uncompressed(small, bytes.size(), "x"), bytes);
  EXPECT_THROW(uncompressed(small, bytes.size() + 1, "x"), Error);
  EXPECT_THROW(uncompressed(small, bytes.size() - 1, "x"), Error);
  EXPECT_THROW(uncompressed(small, std::size_t{1} << 60, "x"), Error) << "must not allocate";
  EXPECT_THROW(uncompressed(Bytes(50, std::byte{1}), 100, "x"), Error);
  EXPECT_TRUE(uncompressed(compressed({}), 0, "x").empty());
}

}  // namespace
}  // namespace footwall::project::detail
