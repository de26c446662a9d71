#include "engine/isosurface/page_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

TEST(PageVector, KeepsItsRoomWhenItShrinks) {
  PageVector<std::uint64_t> numbers;
  EXPECT_TRUE(numbers.empty());
  for (const std::size_t size : {std::size_t{1000}, kHugePage}) {
    numbers.resize_uninitialised(size);
    ASSERT_EQ(numbers.size(), size);
    for (std::size_t n = 0; n < size; ++n) numbers[n] = n;
    EXPECT_EQ(numbers[size - 1], size - 1);
    const auto* const room = numbers.data();
    const std::size_t bytes = numbers.room_bytes();
    EXPECT_GE(bytes, size * sizeof(std::uint64_t));
    numbers.resize_uninitialised(size / 2);
    EXPECT_EQ(numbers.size(), size / 2);
    EXPECT_EQ(numbers.all().size(), size / 2);
    numbers.resize_uninitialised(size);
    EXPECT_EQ(numbers.data(), room);
    EXPECT_EQ(numbers.room_bytes(), bytes);
  }
  numbers.release();
  EXPECT_EQ(numbers.room_bytes(), 0U);
  EXPECT_TRUE(numbers.empty());
}

TEST(PageVector, MovesItsRoom) {
  PageVector<float> one;
  one.resize_uninitialised(3 * kHugePage);
  const float* const room = one.data();
  PageVector<float> other = std::move(one);
  EXPECT_EQ(other.data(), room);
  EXPECT_EQ(other.size(), 3 * kHugePage);
}

TEST(PageVector, StandsOnHugePageBordersWhenLarge) {
  for (const std::size_t bytes :
       {std::size_t{1}, kHugePage - 1, kHugePage, kHugePage + 1, 5 * kHugePage + 17}) {
    const PageRoom room = page_room(bytes);
    const auto place = reinterpret_cast<std::uintptr_t>(room.get());
    EXPECT_EQ(place % (bytes < kHugePage ? 64 : kHugePage), 0U);
    room.get()[0] = std::byte{1};
    room.get()[bytes - 1] = std::byte{1};
  }
}

TEST(PageVector, SaysWhenThereIsNoRoom) {
  for (const std::size_t bytes : {std::numeric_limits<std::size_t>::max(), std::size_t{1} << 60}) {
    try {
      page_room(bytes);
      FAIL() << bytes;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kMemory);
    }
  }
}

}  // namespace
}  // namespace footwall::isosurface
