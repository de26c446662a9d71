// One folder for all ranks, made and removed by rank 0.
#pragma once
#include <gtest/gtest.h>
#include <mpi.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::volume {

class SharedFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    char name[256] = {};
    if (rank_ == 0) {
      made_ = std::make_unique<ScratchFolder>();
      made_->path().string().copy(name, sizeof name - 1);
    }
    MPI_Bcast(name, sizeof name, MPI_CHAR, 0, MPI_COMM_WORLD);
    folder_ = name;
  }
  void TearDown() override { MPI_Barrier(MPI_COMM_WORLD); }

  // The text of the error that f throws on this rank, after checking that all ranks got the same.
  static std::string same_error(ErrorCode code, const std::function<void()>& f) {
    std::string text = "none";
    try {
      f();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      text = error.what();
    }
    char first[1024] = {};
    text.copy(first, sizeof first - 1);
    MPI_Bcast(first, sizeof first, MPI_CHAR, 0, MPI_COMM_WORLD);
    EXPECT_EQ(text, first);
    EXPECT_NE(text, "none");
    return text;
  }

  int rank_ = 0;
  int ranks_ = 1;
  std::unique_ptr<ScratchFolder> made_;  // on rank 0
  std::filesystem::path folder_;
};

}  // namespace footwall::volume
