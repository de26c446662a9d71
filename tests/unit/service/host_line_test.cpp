#include "engine/service/resident/host_line.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <future>
#include <thread>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

TEST(HostLine, BringsEveryWordToEveryMemberInOrder) {
  const ScratchFolder folder;
  HostLineLeader leader(folder / "line");
  struct stat status {};
  ASSERT_EQ(stat((folder / "line").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  std::vector<HostLineMember> members;
  for (int n = 0; n < 3; ++n) members.emplace_back(folder / "line");
  leader.accept(3);
  EXPECT_FALSE(std::filesystem::exists(folder / "line"));
  for (std::uint64_t word = 1; word <= 20; ++word) leader.send(word);
  for (const HostLineMember& member : members) {
    for (std::uint64_t word = 1; word <= 20; ++word) EXPECT_EQ(member.receive(), word);
  }
}

TEST(HostLine, MembersHearThatTheLeaderHasGone) {
  const ScratchFolder folder;
  auto leader = std::make_unique<HostLineLeader>(folder / "line");
  const HostLineMember member(folder / "line");
  leader->accept(1);
  auto word = std::async(std::launch::async, [&] { return member.receive(); });
  leader.reset();
  EXPECT_EQ(word.get(), std::nullopt);
}

TEST(HostLine, AMemberCanBeWokenByItself) {
  const ScratchFolder folder;
  HostLineLeader leader(folder / "line");
  const HostLineMember member(folder / "line");
  leader.accept(1);
  auto word = std::async(std::launch::async, [&] { return member.receive(); });
  member.hang_up();
  EXPECT_EQ(word.get(), std::nullopt);
}

TEST(HostLine, TheLeaderHearsThatAMemberHasGone) {
  const ScratchFolder folder;
  HostLineLeader leader(folder / "line");
  {
    const HostLineMember member(folder / "line");
    leader.accept(1);
  }
  EXPECT_THROW(leader.send(1), Error);
}

TEST(HostLine, TakesThePlaceOfASocketThatAKilledEngineLeft) {
  const ScratchFolder folder;
  const HostLineLeader killed(folder / "line");
  HostLineLeader leader(folder / "line");
  const HostLineMember member(folder / "line");
  leader.accept(1);
  leader.send(7);
  EXPECT_EQ(member.receive(), 7U);
}

TEST(HostLine, SaysWhatIsWrong) {
  const ScratchFolder folder;
  try {
    const HostLineMember member(folder / "nobody");
    FAIL() << "reached a socket that is not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kNotFound);
  }
  try {
    const HostLineLeader leader(folder / std::string(120, 'x'));
    FAIL() << "made a socket with too long a path";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
  }
  HostLineLeader leader(folder / "line");
  try {
    leader.accept(1, std::chrono::milliseconds(10));
    FAIL() << "took a member that never came";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
  }
}

}  // namespace
}  // namespace footwall::service
