#include "storage/volume/volume_reader_parallel.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mpi/volume/shared_folder.h"
#include "storage/volume/volume_writer.h"

namespace footwall::volume {
namespace {

using survey::Box;
using survey::Index;

const Index kDims{37, 29, 41};
const Index kChunk{8, 8, 16};

float value_at(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<float>((i * 1000 + j) * 64 + k) * 0.25F;
}

class ParallelVolumeReaderTest : public SharedFolder {
 protected:
  void SetUp() override {
    SharedFolder::SetUp();
    path_ = folder_ / "v.h5";
    if (rank_ == 0) write();
    MPI_Barrier(MPI_COMM_WORLD);
  }

  void write() const {
    WriteOptions options;
    options.geometry.inlines.count = kDims[0];
    options.geometry.crosslines.count = kDims[1];
    options.geometry.samples = kDims[2];
    options.chunk = kChunk;
    write_volume(
        path_, options,
        [](const Box& box, std::span<float> values, std::span<std::uint8_t>) {
          std::size_t n = 0;
          for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
            for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
              for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = value_at(i, j, k);
            }
          }
        },
        JobContext());
  }

  // This rank's share along the inline axis.
  Box share() const {
    return {{kDims[0] * rank_ / ranks_, 0, 0}, {kDims[0] * (rank_ + 1) / ranks_, kDims[1], kDims[2]}};
  }

  static void expect_values(const Box& box, const std::vector<float>& out) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) ASSERT_EQ(out[n++], value_at(i, j, k));
      }
    }
  }

  static std::int64_t chunks_touched(const Box& box) {
    std::int64_t count = box.empty() ? 0 : 1;
    for (int axis = 0; axis < 3 && count > 0; ++axis) {
      count *= (box.hi[axis] - 1) / kChunk[axis] - box.lo[axis] / kChunk[axis] + 1;
    }
    return count;
  }

  std::filesystem::path path_;
};

TEST_F(ParallelVolumeReaderTest, CollectiveReadsAreCollective) {
  ParallelVolumeReader reader(MPI_COMM_WORLD, path_, {{"romio_cb_read", "automatic"}});
  EXPECT_EQ(reader.info().dims, kDims);
  const Box box = share();
  std::vector<float> out(static_cast<std::size_t>(box.count()));
  reader.read_collective(box, out);
  expect_values(box, out);
  const IoReport& io = reader.last_io();
  EXPECT_EQ(io.asked, IoReport::Mode::kCollective);
  EXPECT_EQ(io.actual, IoReport::Mode::kCollective) << "cause " << io.no_collective_cause;
  EXPECT_EQ(io.no_collective_cause, 0U);
  EXPECT_TRUE(io.linked_chunks);
  EXPECT_EQ(io.chunks, chunks_touched(box));
  EXPECT_EQ(io.bytes, chunks_touched(box) * kChunk[0] * kChunk[1] * kChunk[2] * 4);
  // Parallel: no rank did the others' work.
  std::int64_t all = 0;
  MPI_Allreduce(&io.chunks, &all, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  if (ranks_ > 1) {
    EXPECT_LT(io.chunks, all);
  }
}

TEST_F(ParallelVolumeReaderTest, IndependentReadsNeedNoOtherRank) {
  ParallelVolumeReader reader(MPI_COMM_WORLD, path_);
  if (rank_ == 0) {  // the others are at the barrier below: this would hang if anything were collective
    const Box box{{3, 5, 7}, {30, 21, 40}};
    std::vector<float> out(static_cast<std::size_t>(box.count()));
    reader.read_independent(box, out);
    expect_values(box, out);
    EXPECT_EQ(reader.last_io().asked, IoReport::Mode::kIndependent);
    EXPECT_EQ(reader.last_io().actual, IoReport::Mode::kIndependent);
    EXPECT_EQ(reader.last_io().chunks, chunks_touched(box));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const Box box = share();
  std::vector<float> out(static_cast<std::size_t>(box.count()));
  reader.read_independent(box, out);
  expect_values(box, out);
}

TEST_F(ParallelVolumeReaderTest, RanksMayHaveEmptyBoxesAndUnequalShares) {
  ParallelVolumeReader reader(MPI_COMM_WORLD, path_);
  const bool last = rank_ == ranks_ - 1;
  const Box box = last ? Box{{1, 2, 3}, {36, 28, 33}} : Box{};
  std::vector<float> out(static_cast<std::size_t>(box.count()));
  reader.read_collective(box, out);
  expect_values(box, out);
  EXPECT_EQ(reader.last_io().actual, IoReport::Mode::kCollective);
  EXPECT_EQ(reader.last_io().bytes == 0, !last);
  reader.read_collective({}, {});  // nobody wants anything
  EXPECT_EQ(reader.last_io().transfers, 0);
}

TEST_F(ParallelVolumeReaderTest, OneRanksTroubleIsEverybodysError) {
  if (rank_ == 0) {
    std::ifstream in(path_, std::ios::binary);
    std::string text(4096, ' ');
    in.read(text.data(), 4096);
    const std::string key = "\"voxels_at\":";
    const std::int64_t at = std::stoll(text.substr(text.find(key) + key.size()));
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(at + 12);
    file.put('\x55');
  }
  MPI_Barrier(MPI_COMM_WORLD);
  ParallelVolumeReader reader(MPI_COMM_WORLD, path_);
  const Box box = share();
  std::vector<float> out(static_cast<std::size_t>(box.count()));
  // Only rank 0's box has the altered chunk (with many ranks, its neighbours' too).
  const std::string text = same_error(ErrorCode::kCorrupt, [&] { reader.read_collective(box, out); });
  EXPECT_NE(text.find("chunk 0 (inlines 0 to 7"), std::string::npos) << text;
  // The reader is still usable.
  const Box sound{{8, 8, 16}, {16, 16, 32}};
  std::vector<float> some(static_cast<std::size_t>(sound.count()));
  reader.read_collective(sound, some);
  expect_values(sound, some);
  // A wrong box on the last rank.
  const bool last = rank_ == ranks_ - 1;
  same_error(ErrorCode::kInternal, [&] {
    reader.read_collective(last ? Box{{0, 0, 0}, {99, 1, 1}} : sound, some);
  });
}

TEST_F(ParallelVolumeReaderTest, FilesThatCannotBeOpenedGiveTheSameErrorEverywhere) {
  same_error(ErrorCode::kNotFound, [&] { ParallelVolumeReader(MPI_COMM_WORLD, folder_ / "none.h5"); });
  if (rank_ == 0) std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string text =
      same_error(ErrorCode::kCorrupt, [&] { ParallelVolumeReader(MPI_COMM_WORLD, path_); });
  EXPECT_NE(text.find("truncated"), std::string::npos) << text;
}

}  // namespace
}  // namespace footwall::volume
