#include "storage/base/hash.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "storage/base/error.h"

namespace footwall {
namespace {

TEST(Hash, PiecesGiveTheHashOfTheWhole) {
  std::vector<unsigned char> bytes(100000);
  std::iota(bytes.begin(), bytes.end(), 0);
  const auto all = std::as_bytes(std::span(bytes));
  Hasher hasher;
  hasher.add(all.first(1));
  hasher.add(all.subspan(1, 70000));
  hasher.add(all.subspan(70001));
  EXPECT_EQ(hasher.value(), hash64(all));
}

TEST(Hash, HexReadsBackAndRefusesAnythingElse) {
  EXPECT_EQ(hash_from_hex(to_hex(0x0123456789abcdefULL)), 0x0123456789abcdefULL);
  EXPECT_EQ(to_hex(1), "0000000000000001");
  for (const char* bad : {"", "1", "000000000000000g", "00000000000000001"})
    EXPECT_THROW(hash_from_hex(bad), Error) << bad;
}

}  // namespace
}  // namespace footwall
