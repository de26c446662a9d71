#include "storage/volume/column_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::volume {
namespace {

ColumnTable empty_table() {
  return {{{"kind", ""}},
          0,
          {{"big", {}, std::vector<std::int64_t>()},
           {"corners", {3, 2}, std::vector<std::int32_t>()},
           {"flag", {}, std::vector<std::uint8_t>()},
           {"value", {}, std::vector<double>()}}};
}

ColumnTable some_table(std::int64_t rows) {
  ColumnTable table = empty_table();
  table.texts["kind"] = "Klüfte";
  table.rows = rows;
  for (std::int64_t n = 0; n < rows; ++n) {
    std::get<0>(table.columns[0].values).push_back(std::numeric_limits<std::int64_t>::min() + n);
    for (int k = 0; k < 6; ++k)
      std::get<1>(table.columns[1].values).push_back(static_cast<std::int32_t>(6 * n) - k);
    std::get<2>(table.columns[2].values).push_back(static_cast<std::uint8_t>(n));
    std::get<3>(table.columns[3].values)
        .push_back(n == 1 ? std::numeric_limits<double>::quiet_NaN() : -0.0 * static_cast<double>(n));
  }
  return table;
}

ErrorCode code_of_reading(const std::filesystem::path& path, const ColumnTable& wanted = empty_table()) {
  try {
    read_column_file(path, wanted);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(ColumnFile, ReadsBackBitForBit) {
  const ScratchFolder folder;
  for (const std::int64_t rows : {0, 1, 1000}) {
    const ColumnTable written = some_table(rows);
    write_column_file(written, folder.path() / "t.h5");
    const ColumnTable read = read_column_file(folder.path() / "t.h5", empty_table());
    EXPECT_EQ(read.texts, written.texts);
    EXPECT_EQ(read.rows, rows);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(read.columns[c].values, written.columns[c].values);
    const auto& got = std::get<3>(read.columns[3].values);
    const auto& want = std::get<3>(written.columns[3].values);
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t n = 0; n < got.size(); ++n)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(got[n]), std::bit_cast<std::uint64_t>(want[n]));
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename(), "t.h5");  // no temporary file stays
}

TEST(ColumnFile, OtherTypesShapesAndNamesAreRefused) {
  const ScratchFolder folder;
  const auto path = folder.path() / "t.h5";
  write_column_file(some_table(5), path);
  ColumnTable other = empty_table();
  other.columns[0].values = std::vector<double>();
  EXPECT_EQ(code_of_reading(path, other), ErrorCode::kFormat);
  other = empty_table();
  other.columns[1].inner = {2, 3};
  EXPECT_EQ(code_of_reading(path, other), ErrorCode::kFormat);
  other = empty_table();
  other.columns[2].name = "flags";
  EXPECT_EQ(code_of_reading(path, other), ErrorCode::kFormat);
  other = empty_table();
  other.texts["sort"];
  EXPECT_EQ(code_of_reading(path, other), ErrorCode::kFormat);
  EXPECT_EQ(code_of_reading(folder.path() / "none.h5"), ErrorCode::kNotFound);
}

TEST(ColumnFile, DamageIsNoticedAndNeverCrashes) {
  const ScratchFolder folder;
  const auto path = folder.path() / "t.h5";
  write_column_file(some_table(40), path);
  const std::string whole = read_whole_file(path, 1 << 20);
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    write_whole_file(path, whole.substr(0, size));
    const ErrorCode code = code_of_reading(path);
    EXPECT_TRUE(code == ErrorCode::kFormat || code == ErrorCode::kCorrupt) << size;
  }
  // A value altered: the check tells. "big" starts with the smallest of all integers, little-endian.
  const std::string first("\0\0\0\0\0\0\0\x80\1\0\0\0\0\0\0\x80", 16);
  const std::size_t at = whole.find(first);
  ASSERT_NE(at, std::string::npos);
  std::string altered = whole;
  altered[at + 3] = 1;
  write_whole_file(path, altered);
  EXPECT_EQ(code_of_reading(path), ErrorCode::kCorrupt);
}

TEST(ColumnFile, AFolderThatIsNotThereIsAnError) {
  const ScratchFolder folder;
  EXPECT_THROW(write_column_file(some_table(2), folder.path() / "no" / "t.h5"), Error);
}

}  // namespace
}  // namespace footwall::volume
