#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>

#include "storage/base/partial_file.h"
#include "storage/project/detail/writer_lock.h"
#include "unit/project/project_folder.h"

namespace footwall::project::detail {
namespace {

class LeaseTest : public ProjectFolder {
 protected:
  void write_lease(const std::string& host, std::int64_t pid, int seconds_ago) {
    Holder holder;
    holder.host = host;
    holder.pid = pid;
    holder.process_start = 5;
    holder.machine = machine_;
    holder.lease = true;
    holder.since = "2024-01-01T00:00:00Z";
    holder.token = "theirs";
    write_whole_file(lock_path(path_), holder.to_json());
    std::filesystem::last_write_time(
        lock_path(path_), std::filesystem::file_time_type::clock::now() - std::chrono::seconds(seconds_ago));
  }
  std::string machine_ = "another machine";
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
};

TEST_F(LeaseTest, IsFreeAgainAfterItsHolder) {
  {
    const auto mine = lease(path_, "/run/socket");
    EXPECT_NO_THROW(mine->check());
    EXPECT_EQ(Holder::from_json(read_whole_file(lock_path(path_), 4096)).edit_socket, "/run/socket");
    EXPECT_EQ(error_of([&] { lease(path_, ""); }).code(), ErrorCode::kHeld);
    EXPECT_NO_THROW(mine->check()) << "a refused one must leave it alone";
  }
  EXPECT_EQ(files(), 0U);
  EXPECT_TRUE(lease(path_, "")->taken_over().empty());
}

TEST_F(LeaseTest, AFreshOneOfAnotherHostHoldsAndAStaleOneIsTakenOver) {
  write_lease("other", 17, 30);
  const Error error = error_of([&] { lease(path_, ""); });
  EXPECT_EQ(error.code(), ErrorCode::kHeld);
  EXPECT_NE(error.message().find("process 17 on host 'other'"), std::string::npos);
  EXPECT_EQ(files(), 1U);
  write_lease("other", 17, 90);
  const auto mine = lease(path_, "");
  EXPECT_NE(mine->taken_over().find("'other'"), std::string::npos);
  EXPECT_NO_THROW(mine->check());
  EXPECT_EQ(files(), 1U);
}

TEST_F(LeaseTest, ADeadProcessOfThisHostHoldsNothing) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  machine_ = Holder::myself("").machine;
  ASSERT_FALSE(machine_.empty());
  write_lease(Holder::myself("").host, child, 0);
  EXPECT_FALSE(lease(path_, "")->taken_over().empty());
  // A host of the same name, a container for one, has processes that we cannot see.
  machine_ = "another machine";
  write_lease(Holder::myself("").host, child, 0);
  EXPECT_EQ(error_of([&] { lease(path_, ""); }).code(), ErrorCode::kHeld);
}

TEST_F(LeaseTest, AClockThatWasPutBackKeepsNoLeaseAlive) {
  write_lease("other", 17, -30);
  EXPECT_EQ(error_of([&] { lease(path_, ""); }).code(), ErrorCode::kHeld);
  write_lease("other", 17, -3600);
  EXPECT_FALSE(lease(path_, "")->taken_over().empty());
}

TEST_F(LeaseTest, AFolderSeenAsLocalAndAsNetworkHasOneWriter) {
  write_lease("client", 17, 0);
  EXPECT_EQ(error_of([&] { lock_locally(path_, ""); }).code(), ErrorCode::kHeld);
  EXPECT_TRUE(std::filesystem::exists(lock_path(path_))) << "the lease must stay";
  write_lease("client", 17, 90);
  {
    const auto mine = lock_locally(path_, "");
    EXPECT_NE(mine->taken_over().find("'client'"), std::string::npos);
    EXPECT_EQ(error_of([&] { lease(path_, ""); }).code(), ErrorCode::kHeld);
    EXPECT_NO_THROW(mine->check());
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(LeaseTest, ALostOneIsNoticedAndNotRemovedByItsFormerHolder) {
  {
    const auto mine = lease(path_, "");
    write_lease("other", 17, 0);
    EXPECT_EQ(error_of([&] { mine->check(); }).code(), ErrorCode::kHeld);
  }
  EXPECT_TRUE(std::filesystem::exists(lock_path(path_)));
}

TEST_F(LeaseTest, ALockFileFullOfRubbishIsNoTrap) {
  for (const std::string& text : {std::string(), std::string(4000, '['),
                                  std::string("{\"host\":7,\"pid\":\"x\"}"), std::string("\x1b[2J")}) {
    write_whole_file(lock_path(path_), text);
    EXPECT_EQ(error_of([&] { lease(path_, ""); }).code(), ErrorCode::kHeld);
    EXPECT_NO_THROW(lock_locally(path_, ""));
  }
}

TEST_F(LeaseTest, WhatAHolderWroteIsPrintedAsPlainText) {
  const auto holder = Holder::from_json(R"({"host":"a\u001b[31mb","pid":3,"token":"t"})");
  EXPECT_EQ(holder.in_words().find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace footwall::project::detail
