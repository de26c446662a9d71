#include "engine/tasks/bench_voxelize.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

Error error_of(std::string_view text) {
  try {
    parse_triangles_csv(text, "f.csv");
  } catch (const Error& error) {
    return error;
  }
  return Error(ErrorCode::kInternal, "nothing was thrown");
}

TEST(TrianglesCsv, TakesHeadersCommentsSeparatorsAndLineEnds) {
  const auto t = parse_triangles_csv(
      "\xEF\xBB\xBFi0,j0,k0,i1,j1,k1,i2,j2,k2\r\n"
      "# a comment\r\n"
      "1, 2,3, 4,5,6, 7,8,9.5\r\n"
      "\n"
      "1;2;3;4;5;6;7;8;9\n"
      "1 2 3\t4 5 6  7 8 -9e0",
      "f.csv");
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0][0], (survey::LatticePoint{256, 512, 768}));
  EXPECT_EQ(t[0][2], (survey::LatticePoint{7 * 256, 8 * 256, 9 * 256 + 128}));
  EXPECT_EQ(t[2][2].k, -9 * 256);
  EXPECT_TRUE(parse_triangles_csv("", "f.csv").empty());
  EXPECT_TRUE(parse_triangles_csv("a,b\n", "f.csv").empty());
}

TEST(TrianglesCsv, ErrorsNameLineAndColumn) {
  const Error word = error_of("\n1,2,3,4,x,6,7,8,9\n");
  EXPECT_EQ(word.code(), ErrorCode::kFormat);
  EXPECT_NE(word.message().find("f.csv, line 2, column 5"), std::string::npos) << word.message();
  const Error few = error_of("1,2,3,4,5,6,7,8,9\r\n1,2,3\r\n");
  EXPECT_NE(few.message().find("line 2: 3 fields"), std::string::npos) << few.message();
  for (const char* bad : {"nan", "inf", "8388608", "-1e300"}) {
    const Error far = error_of(std::string("0,0,0,0,0,0,0,") + bad + ",0");
    EXPECT_EQ(far.code(), ErrorCode::kInvalid) << bad;
    EXPECT_NE(far.message().find("line 1, columns 7 to 9"), std::string::npos) << far.message();
  }
  // Only the first line may be a header.
  EXPECT_EQ(error_of("1,2,3,4,5,6,7,8,9\na,b,c,d,e,f,g,h,i\n").code(), ErrorCode::kFormat);
}

class BenchVoxelize : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.triangles = folder_ / "t.csv";
    options_.repeats = 2;
    write_whole_file(options_.triangles,
                     "0,0,0,0,0,0,0,0,0\n"                    // a point in one voxel
                     "0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5\n"  // a point on a corner of eight
                     "0,0,0,0,9,0,0,0,9\n"                    // a right triangle in one layer
                     "0,0,0,300,200,10,7,250,180\n");
  }
  ScratchFolder folder_;
  BenchVoxelizeOptions options_;
};

TEST_F(BenchVoxelize, CountsEachTriangleWhateverTheThreads) {
  const auto one = bench_voxelize(options_, JobContext());
  ASSERT_EQ(one.counts.size(), 4u);
  EXPECT_EQ(one.counts[0], 1);
  EXPECT_EQ(one.counts[1], 8);
  // 10 x 10 squares, less those beyond the diagonal y + z = 9, which touches the squares of y + z = 10.
  EXPECT_EQ(one.counts[2], 55 + 9);
  EXPECT_EQ(one.voxels, one.counts[0] + one.counts[1] + one.counts[2] + one.counts[3]);
  EXPECT_EQ(one.seconds_each.size(), 2u);
  EXPECT_EQ(one.check.triangles, 4);
  options_.threads = 3;
  EXPECT_EQ(bench_voxelize(options_, JobContext()).counts, one.counts);
}

TEST_F(BenchVoxelize, ListsTheVoxels) {
  options_.list = folder_ / "list.csv";
  const auto result = bench_voxelize(options_, JobContext());
  std::istringstream lines(read_whole_file(options_.list, 1 << 24));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "triangle,i,j,k");
  std::getline(lines, line);
  EXPECT_EQ(line, "0,0,0,0");
  std::int64_t listed = 1;
  while (std::getline(lines, line)) ++listed;
  EXPECT_EQ(listed, result.voxels);
}

TEST_F(BenchVoxelize, RefusesWhatCannotBeDone) {
  const auto code_of = [&] {
    try {
      bench_voxelize(options_, JobContext());
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  options_.voxelizer = "gpu";
  EXPECT_EQ(code_of(), ErrorCode::kUsage);
  options_.voxelizer = "exact";
  options_.threads = 0;
  EXPECT_EQ(code_of(), ErrorCode::kUsage);
  options_.threads = 1;
  options_.repeats = 0;
  EXPECT_EQ(code_of(), ErrorCode::kUsage);
  options_.repeats = 1;
  options_.triangles = folder_ / "missing.csv";
  EXPECT_EQ(code_of(), ErrorCode::kNotFound);
}

TEST_F(BenchVoxelize, CanBeCancelled) {
  const JobContext job;
  job.cancel();
  try {
    bench_voxelize(options_, job);
    FAIL() << "ran although cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

}  // namespace
}  // namespace footwall::tasks
