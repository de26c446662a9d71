// The map of bins, duplicates among them, and single lines, against the made traces.
#include "storage/formats/segy/survey_look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scratch_folder.h"
#include "segy_sample_file.h"

namespace footwall::formats::segy {
namespace {

TEST(SegySurveyLook, MapTellsHolesAndDuplicates) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(6, 5, 8);
  const SampleTrace doubled = made.traces[7];
  made.traces.erase(made.traces.begin() + 12);  // bin (2, 2)
  made.traces.push_back(doubled);               // bin (1, 2)
  const SurveyLook look(folder.file("a.sgy", made.bytes()), {}, {});
  ASSERT_TRUE(look.found().geometry);
  ASSERT_EQ(look.map().rows, 6);
  ASSERT_EQ(look.map().columns, 5);
  for (std::int64_t i = 0; i < 6; ++i) {
    for (std::int64_t j = 0; j < 5; ++j) {
      const Bin wanted = i == 2 && j == 2 ? Bin::kHole : i == 1 && j == 2 ? Bin::kDuplicate : Bin::kLive;
      EXPECT_EQ(look.map().at(i, j), wanted) << i << " " << j;
    }
  }
  EXPECT_EQ(look.bytes_written(), 6 * 5 * 8 * 4);

  for (const bool of_inline : {true, false}) {
    const LinePreview line = look.line(of_inline, 2, {});
    const SegyFile file = SegyFile::scan(folder.file("a.sgy", made.bytes()), {});
    survey::Box box = file.geometry().box();
    box.lo[of_inline ? 0 : 1] = 2;
    box.hi[of_inline ? 0 : 1] = 3;
    std::vector<float> wanted(static_cast<std::size_t>(box.count()));
    std::vector<std::uint8_t> live(static_cast<std::size_t>(box.size(0) * box.size(1)));
    file.read_block(box, wanted, live);
    ASSERT_EQ(line.values.size(), wanted.size());
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      EXPECT_TRUE(line.values[n] == wanted[n] || (std::isnan(line.values[n]) && std::isnan(wanted[n]))) << n;
    }
  }
}

TEST(SegySurveyLook, ARefusedFileStillHasItsReport) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(1, 4, 8);
  made.traces.clear();
  const SurveyLook look(folder.file("a.sgy", made.bytes()), {}, {});
  EXPECT_TRUE(look.found().refusal);
  EXPECT_EQ(look.map().rows, 0);
  EXPECT_EQ(look.bytes_read(), 0);
  EXPECT_TRUE(look.line(true, 0, {}).values.empty());
}

}  // namespace
}  // namespace footwall::formats::segy
