#include "storage/formats/detail/read_only_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/formats/detail/page_buffer.h"

namespace footwall::formats::detail {
namespace {

std::string counted(std::size_t bytes) {
  std::string text(bytes, ' ');
  for (std::size_t n = 0; n < bytes; ++n) text[n] = static_cast<char>(n * 2654435761U >> 13);
  return text;
}

void forget_pages(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  ::fsync(descriptor);
  ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
  ::close(descriptor);
}

TEST(PageBuffer, HoldsExactlyTheBytesWhetherCachedOrNot) {
  const ScratchFolder folder;
  const std::string text = counted(5 * kPageBytes + 123);
  const auto path = folder.file("a", text);
  const ReadOnlyFile file(path);
  const std::vector<std::pair<std::size_t, std::size_t>> pieces{{0, text.size()},      {1, 1},
                                                                {kPageBytes - 1, 2},   {5000, 9000},
                                                                {5 * kPageBytes, 123}, {text.size() - 1, 1}};
  PageBuffer buffer;
  for (const auto way : {PageBuffer::Way::kPastCache, PageBuffer::Way::kThroughCache}) {
    for (const auto& [offset, size] : pieces) {
      for (const bool cached : {false, true}) {
        if (!cached) forget_pages(path);
        const auto at = static_cast<std::int64_t>(offset);
        buffer.read(file, at, static_cast<std::int64_t>(size), way);
        EXPECT_TRUE(std::string(reinterpret_cast<const char*>(buffer.at(at)), size) ==
                    text.substr(offset, size))
            << offset << ' ' << size << ' ' << cached;
        EXPECT_TRUE(buffer.holds(at, static_cast<std::int64_t>(size)));
        EXPECT_FALSE(buffer.holds(at, static_cast<std::int64_t>(size) + 1));
      }
    }
  }
}

TEST(PageBuffer, AFileThatHasShrunkIsAnErrorAndNothingIsHeld) {
  const ScratchFolder folder;
  const auto path = folder.file("a", counted(3 * kPageBytes));
  const ReadOnlyFile file(path);
  std::filesystem::resize_file(path, kPageBytes + 10);
  PageBuffer buffer;
  for (const auto way : {PageBuffer::Way::kPastCache, PageBuffer::Way::kThroughCache}) {
    try {
      buffer.read(file, 100, 2 * kPageBytes, way);
      FAIL() << "bytes that are not there were read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
      EXPECT_NE(error.message().find("ends at byte 4106"), std::string::npos) << error.message();
    }
    EXPECT_FALSE(buffer.holds(100, 1));
  }
}

}  // namespace
}  // namespace footwall::formats::detail
