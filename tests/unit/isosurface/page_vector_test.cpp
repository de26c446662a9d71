#include "engine/isosurface/page_vector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

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

TEST(PageVector, KeepsWhatItHasWhenItGrows) {
  PageVector<std::uint64_t> numbers;
  std::size_t size = 0;
  for (const std::size_t next :
       {std::size_t{3}, std::size_t{20'000}, kHugePage / 8 - 1, kHugePage / 4, kHugePage}) {
    numbers.grow(next);
    ASSERT_EQ(numbers.size(), next);
    for (std::size_t n = size; n < next; ++n) numbers[n] = n;
    size = next;
    for (std::size_t n = 0; n < size; ++n) ASSERT_EQ(numbers[n], n);
  }
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

TEST(PageVector, GrowsInItsPlaceWhereRoomIsReserved) {
  PageVector<std::uint64_t> numbers;
  for (const std::size_t most : {std::size_t{100}, kHugePage, std::size_t{1} << 32}) {
    ASSERT_TRUE(numbers.reserve(most));
    EXPECT_TRUE(numbers.empty());
    numbers.grow(1);
    numbers[0] = 7;
    const auto* const room = numbers.data();
    const std::size_t size = std::min(most, kHugePage);
    numbers.grow(size);
    for (std::size_t page = 0; (page + 1) * kHugePage <= numbers.room_bytes() && page < 9; ++page) {
      numbers.make_page(page);
    }
    numbers[size - 1] = 8;
    EXPECT_EQ(numbers.data(), room);
    numbers.trim();
    EXPECT_EQ(numbers.data(), room);
    EXPECT_EQ(numbers[0], 7U);
    EXPECT_EQ(numbers[size - 1], 8U);
    EXPECT_LE(numbers.room_bytes(), std::max(size * sizeof(std::uint64_t), 8 * kHugePage));
  }
  // What a larger content left behind is kept.
  const std::size_t bytes = numbers.room_bytes();
  ASSERT_TRUE(numbers.reserve(std::size_t{1} << 32));
  numbers.grow(5);
  numbers.trim();
  EXPECT_EQ(numbers.room_bytes(), bytes);
}

TEST(PageVector, GivesAllAddressesBackWhenNothingWasWritten) {
  PageVector<std::uint64_t> numbers;
  ASSERT_TRUE(numbers.reserve(std::size_t{1} << 32));
  numbers.trim();
  EXPECT_EQ(numbers.room_bytes(), 0U);
}

TEST(PageVector, KeepsItsRoomWhereMoreCannotBeReserved) {
  PageVector<std::uint64_t> numbers;
  numbers.resize_uninitialised(kHugePage);
  const std::size_t bytes = numbers.room_bytes();
  EXPECT_FALSE(numbers.reserve(std::size_t{1} << 55));
  EXPECT_FALSE(numbers.reserve(std::size_t{1} << 60));
  EXPECT_EQ(numbers.room_bytes(), bytes);
  numbers.trim();
  EXPECT_EQ(numbers.room_bytes(), bytes);
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
