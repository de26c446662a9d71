#include "storage/formats/detail/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <csignal>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::detail {
namespace {

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const ScratchFolder folder;
  {
    OutputFile out(folder / "a.txt");
    out.print("{} and {}\n", 1, "two");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
    out.commit();
  }
  EXPECT_EQ(content_of(folder / "a.txt"), "1 and two\n");
  { OutputFile(folder / "b.txt").write("lost"); }
  EXPECT_FALSE(std::filesystem::exists(folder / "b.txt"));
  EXPECT_THROW(OutputFile(folder / "none" / "c.txt"), Error);
}

TEST(OutputFile, LargeAndSmallWritesKeepTheirOrder) {
  const ScratchFolder folder;
  const std::string large(3 << 20, 'x');
  OutputFile out(folder / "a.txt");
  out.write("first");
  out.write(large);
  out.write("last");
  out.commit();
  EXPECT_EQ(content_of(folder / "a.txt"), "first" + large + "last");
}

// A limit on the size of files fails in the same place as a full disk.
TEST(OutputFile, ARefusedWriteIsAnErrorAndLeavesNothing) {
  const ScratchFolder folder;
  std::filesystem::path path = folder / "a.txt";
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit limited = before;
  limited.rlim_cur = 100000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limited), 0);
  ErrorCode code = ErrorCode::kInternal;
  try {
    OutputFile out(path);
    out.write(std::string(200000, 'x'));
    out.commit();
  } catch (const Error& error) {
    code = error.code();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(code, ErrorCode::kIo);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace footwall::formats::detail
