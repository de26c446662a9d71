#include "storage/formats/segy/trace_windows.h"

#include <gtest/gtest.h>

#include <random>

#include "scratch_folder.h"

namespace footwall::formats::segy {
namespace {

// Windows of 1 MiB hold some of its traces, never all.
class Made {
 public:
  Made() {
    layout.first_trace = 3600;
    layout.trace_size = 10007;  // nothing falls on pages
    layout.traces = 1200;
    content.resize(static_cast<std::size_t>(layout.offset_of(layout.traces)));
    std::mt19937 random(3);
    for (char& byte : content) byte = static_cast<char>(random());
    path = folder.file("a.sgy", content);
  }
  bool same(const std::byte* bytes, const TraceRun& run) const {
    const auto at = static_cast<std::size_t>(layout.offset_of(run.first));
    const auto size = static_cast<std::size_t>(run.count * layout.trace_size);
    return content.compare(at, size, reinterpret_cast<const char*>(bytes), size) == 0;
  }

  ScratchFolder folder;
  Layout layout;
  std::string content;
  std::filesystem::path path;
};

TEST(SegyTraceWindows, RowsThatGoOnBlockByBlock) {
  const Made made;
  const detail::ReadOnlyFile file(made.path);
  TraceWindows windows;
  for (std::int64_t block = 0; block < 20; ++block) {
    for (std::int64_t row = 0; row < 6; ++row) {
      const TraceRun run{row * 200 + block * 10, 10, 200 - (block + 1) * 10};
      windows.ask_for(run, 6, file, made.layout);
      EXPECT_TRUE(made.same(windows.bytes_of(run, 6, file, made.layout), run)) << block << ' ' << row;
    }
  }
}

TEST(SegyTraceWindows, AnyRunsInAnyOrder) {
  const Made made;
  const detail::ReadOnlyFile file(made.path);
  TraceWindows windows;
  std::mt19937 random(9);
  for (int n = 0; n < 3000; ++n) {
    TraceRun run;
    run.first = static_cast<std::int64_t>(random() % 1200);
    run.count = 1 + static_cast<std::int64_t>(random() % 40) % (1200 - run.first);
    run.next = static_cast<std::int64_t>(random()) % (1200 - run.first - run.count + 1);
    ASSERT_TRUE(made.same(windows.bytes_of(run, 1 + n % 100, file, made.layout), run)) << n;
  }
}

}  // namespace
}  // namespace footwall::formats::segy
