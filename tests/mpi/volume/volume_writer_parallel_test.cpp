#include "storage/volume/volume_writer_parallel.h"

#include <omp.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>

#include "mpi/volume/shared_folder.h"
#include "unit/volume/volume_fixture.h"

namespace footwall::volume {
namespace {

using survey::Box;
using survey::Index;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kNullValue = -999.25F;

// Every kind of value there is: nulls of all sorts, zeros of both signs, dead traces.
float ugly(std::int64_t i, std::int64_t j, std::int64_t k) {
  switch ((i * 7 + j * 5 + k * 3) % 17) {
    case 0:
      return kNaN;
    case 1:
      return kNullValue;
    case 2:
      return (i + k) % 2 == 0 ? std::numeric_limits<float>::infinity()
                              : -std::numeric_limits<float>::infinity();
    case 3:
      return 0.0F;
    case 4:
      return -0.0F;
    default:
      return wavy(i, j, k);
  }
}
bool alive(std::int64_t i, std::int64_t j) {
  return (i + j) % 9 != 0;
}

class ParallelVolumeWriterTest : public SharedFolder {
 protected:
  void SetUp() override {
    SharedFolder::SetUp();
    path_ = folder_ / "all.h5";
  }
  std::ptrdiff_t entries() const {
    MPI_Barrier(MPI_COMM_WORLD);
    const std::ptrdiff_t count = std::distance(std::filesystem::directory_iterator(folder_), {});
    MPI_Barrier(MPI_COMM_WORLD);
    return count;
  }
  VolumeInfo write(const WriteOptions& options, const BlockSource& source, const JobContext& job = {}) const {
    return write_volume_parallel(MPI_COMM_WORLD, path_, options, source, job);
  }

  std::filesystem::path path_;
};

// With more ranks than blocks, blocks that end inside the pyramid's bricks, and one voxel.
TEST_F(ParallelVolumeWriterTest, TheFileIsThatOfTheSerialWriterToTheByte) {
  const std::vector<std::pair<Index, Index>> shapes{{{1, 1, 1}, {64, 64, 64}},  {{1, 37, 1}, {1, 8, 1}},
                                                    {{5, 1, 90}, {4, 4, 32}},   {{9, 9, 9}, {8, 8, 8}},
                                                    {{17, 23, 41}, {5, 7, 8}},  {{40, 25, 70}, {16, 8, 64}},
                                                    {{33, 50, 20}, {1, 16, 8}}, {{64, 64, 40}, {8, 8, 16}}};
  for (const auto& [dims, chunk] : shapes) {
    SCOPED_TRACE(std::to_string(dims[0]) + "x" + std::to_string(dims[1]) + "x" + std::to_string(dims[2]));
    WriteOptions options = options_for(dims);
    options.chunk = chunk;
    options.null_value = kNullValue;
    options.role = Role::kDiscontinuity;
    const VolumeInfo info = write(options, source_of(ugly, alive));
    // 1 All ranks know the same, and it is what the file says.
    const VolumeReader reader(path_);
    EXPECT_EQ(info.checksum, reader.info().checksum);
    EXPECT_EQ(info.statistics, reader.info().statistics);
    EXPECT_EQ(info.bytes, reader.info().bytes);
    EXPECT_EQ(info.chunk, reader.info().chunk);
    EXPECT_EQ(info.geometry, options.geometry);
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank_ != 0) continue;
    // 2 Value for value, hash for hash, byte for byte.
    const VolumeInfo alone = write_volume(folder_ / "alone.h5", options, source_of(ugly, alive), {});
    EXPECT_EQ(info.checksum, alone.checksum);
    EXPECT_EQ(info.statistics, alone.statistics);
    EXPECT_TRUE(content_of(path_) == content_of(folder_ / "alone.h5"));
    reader.verify({});
  }
}

TEST_F(ParallelVolumeWriterTest, ThreadsOfRanksDoNotShow) {
  WriteOptions options = options_for({40, 50, 60});
  options.chunk = Index{8, 8, 16};
  const int before = omp_get_max_threads();
  omp_set_num_threads(1 + rank_ % 3);
  write(options, source_of(ugly, alive));
  omp_set_num_threads(before);
  if (rank_ != 0) return;
  write_volume(folder_ / "alone.h5", options, source_of(ugly, alive), {});
  EXPECT_TRUE(content_of(path_) == content_of(folder_ / "alone.h5"));
}

TEST_F(ParallelVolumeWriterTest, ASurveyOfNullsHasNoStatistics) {
  const VolumeInfo info = write(options_for({70, 40, 4}), source_of([](auto, auto, auto) { return kNaN; }));
  EXPECT_EQ(info.statistics.count, 0);
  EXPECT_EQ(info.statistics.null_count, 70 * 40 * 4);
}

TEST_F(ParallelVolumeWriterTest, EveryRankMakesItsShareAndNoBlockIsMadeTwice) {
  WriteOptions options = options_for({40, 33, 20});
  options.chunk = Index{8, 8, 8};  // 5 x 5 blocks
  std::vector<int> asked(25);
  int mine = 0;
  std::int64_t last = -1;
  write(options, [&](const Box& box, std::span<float> values, std::span<std::uint8_t>) {
    EXPECT_EQ(box.lo[2], 0);
    EXPECT_EQ(box.hi[2], 20);
    const std::int64_t number = box.lo[0] / 8 * 5 + box.lo[1] / 8;
    EXPECT_TRUE(last < 0 || number == last + 1);
    last = number;
    ++asked[static_cast<std::size_t>(number)];
    ++mine;
    std::fill(values.begin(), values.end(), 1.0F);
  });
  EXPECT_GE(mine, 25 / ranks_);
  EXPECT_LE(mine, 25 / ranks_ + 1);
  MPI_Allreduce(MPI_IN_PLACE, asked.data(), 25, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(asked, std::vector<int>(25, 1));
}

TEST_F(ParallelVolumeWriterTest, CancelOrAFailingSourceOfAnyRankLeavesTheOldFileAlone) {
  WriteOptions options = options_for({64, 8, 8});
  options.chunk = Index{4, 8, 8};
  const VolumeInfo old = write(options, source_of(wavy));
  for (int bad = 0; bad < ranks_; ++bad) {
    const JobContext job;
    bool begun = false;
    same_error(ErrorCode::kCancelled, [&] {
      write(
          options,
          [&](const Box&, std::span<float> values, std::span<std::uint8_t>) {
            std::fill(values.begin(), values.end(), 1.0F);
            if (rank_ == bad) job.cancel();
            begun = true;
          },
          job);
    });
    EXPECT_TRUE(begun);
    const std::string text = same_error(ErrorCode::kFormat, [&] {
      write(options, [&](const Box&, std::span<float>, std::span<std::uint8_t>) {
        if (rank_ == bad) throw Error(ErrorCode::kFormat, "trace " + std::to_string(rank_) + " is short");
      });
    });
    EXPECT_NE(text.find("trace " + std::to_string(bad)), std::string::npos) << text;
  }
  EXPECT_EQ(entries(), 1);
  EXPECT_EQ(VolumeReader(path_).info().checksum, old.checksum);
}

TEST_F(ParallelVolumeWriterTest, ProgressIsThatOfAllRanksAndNeverFalls) {
  WriteOptions options = options_for({64, 8, 8});
  options.chunk = Index{4, 8, 8};
  double last = 0;
  const JobContext job([&](const Progress& progress) {
    EXPECT_GE(progress.fraction, last);
    EXPECT_EQ(progress.phase, "write");
    last = progress.fraction;
  });
  write(options, source_of(wavy), job);
  EXPECT_EQ(last, 1);
}

TEST_F(ParallelVolumeWriterTest, AFullDiskOfAnyRankIsEverybodysErrorAndLeavesNothing) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  // At rank 0 the room cannot be taken; at the last one, whose chunks come last, they cannot be written.
  for (const int bad : {0, ranks_ - 1}) {
    const rlimit limit{rank_ == bad ? 1U << 20 : before.rlim_cur, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    const std::string text = same_error(ErrorCode::kIo, [&] {
      write(options_for({64, 256, 256}), source_of(wavy));
    });
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_NE(text.find("cannot write"), std::string::npos) << text;
    EXPECT_EQ(entries(), 0);
  }
  std::signal(SIGXFSZ, SIG_DFL);
}

TEST_F(ParallelVolumeWriterTest, WhatCannotBeStoredIsRefusedBeforeTheSourceIsAsked) {
  const BlockSource never = [](const Box&, std::span<float>, std::span<std::uint8_t>) {
    ADD_FAILURE() << "the source was asked";
  };
  WriteOptions options = options_for({4, 4, 4});
  options.provenance_json = "{not json";
  same_error(ErrorCode::kInvalid, [&] { write(options, never); });
  same_error(ErrorCode::kIo, [&] { write(options_for({1 << 20, 1 << 20, 64}), never); });
  path_ = folder_ / "no such folder" / "v.h5";
  same_error(ErrorCode::kNotFound, [&] { write(options_for({4, 4, 4}), never); });
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace footwall::volume
