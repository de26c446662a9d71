#include "storage/volume/chunk_output.h"

#include <gtest/gtest.h>

#include <cstring>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/base/pages.h"

namespace footwall::volume {
namespace {

TEST(ChunkOutput, PagesAndOddPiecesLandWhereTheyShould) {
  const ScratchFolder folder;
  std::string expected(5 * kPageBytes, '.');
  const auto path = folder.file("v", expected);
  const Pages memory = allocate_pages(3 * kPageBytes);
  for (std::size_t n = 0; n < 3 * kPageBytes; ++n) memory[n] = static_cast<std::byte>('a' + n % 23);
  const auto* text = reinterpret_cast<const char*>(memory.get());
  {
    const ChunkOutput out(path);
    const auto put = [&](std::size_t at, std::size_t from, std::size_t size) {
      out.write(static_cast<std::int64_t>(at), {memory.get() + from, size});
      expected.replace(at, size, text + from, size);
    };
    put(kPageBytes, 0, 2 * kPageBytes);  // straight to the disk
    put(4 * kPageBytes - 7, 11, 100);    // across a page's end
    put(0, 5, kPageBytes);               // from memory that is not on a page
    put(4 * kPageBytes, kPageBytes, kPageBytes);
  }
  EXPECT_TRUE(content_of(path) == expected);
}

TEST(ChunkOutput, AFullDeviceAndAMissingFileAreErrors) {
  const std::byte one{1};
  EXPECT_THROW(ChunkOutput("/dev/full").write(0, {&one, 1}), Error);
  EXPECT_THROW(ChunkOutput("/nowhere/at/all"), Error);
}

}  // namespace
}  // namespace footwall::volume
