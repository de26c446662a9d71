#include "storage/formats/charisma.h"

#include "real_files.h"
#include "storage/formats/stick_formats.h"

namespace footwall::formats {
namespace {

TEST(RealCharisma, FourSticksOfThreeNodes) {
  FOOTWALL_NEEDS_REAL_FILES();
  const SticksImport read =
      read_sticks(real_files() / "softwareunderground+subsurface/tests/data/faults/faultsticks", "", {});
  EXPECT_EQ(read.format, "charisma");
  ASSERT_EQ(read.sticks.size(), 4u);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(read.sticks[n].fault, "gp_fault7");
    EXPECT_EQ(read.sticks[n].number, static_cast<std::int64_t>(n) + 1);
    EXPECT_EQ(read.sticks[n].points.size(), 3u);
  }
  EXPECT_EQ(read.sticks[0].points[2], (survey::WorldPoint{758040.00984, 3788153.46427, 2262.71870}));
  EXPECT_EQ(read.report.rejected_count, 0);
  EXPECT_EQ(read.report.skipped, 0);
}

}  // namespace
}  // namespace footwall::formats
