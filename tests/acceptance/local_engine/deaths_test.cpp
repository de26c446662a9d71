#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <bit>
#include <fstream>
#include <mutex>
#include <sstream>

#include "engine/service/client/local_engine.h"
#include "engine/service/wire.h"
#include "engine/session/private_folder.h"
#include "engine/tasks/new_project.h"
#include "engine/tasks/replay_project.h"
#include "scratch_folder.h"

namespace footwall::service {
namespace {

using Numbers = std::map<extract::FaceIdentity, std::array<std::uint64_t, 4>>;

void take(const v1::FaceNumbers& message, Numbers& to) {
  for (const NumberedFace& each : numbers_from(message)) {
    const extract::FaceStatistics& numbers = each.statistics;
    to[each.face] = {static_cast<std::uint64_t>(numbers.count), std::bit_cast<std::uint64_t>(numbers.mean),
                     std::bit_cast<std::uint64_t>(numbers.variance),
                     std::bit_cast<std::uint64_t>(numbers.min)};
  }
}

int parent_of(int process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  std::istringstream rest(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string state;
  int parent = 0;
  rest >> state >> parent;
  return parent;
}

// One whose launcher was left by its keeper may take a moment.
bool ends(int process) {
  const auto descriptor = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (descriptor < 0) return true;
  pollfd wanted{descriptor, POLLIN, 0};
  const bool ended = poll(&wanted, 1, 20'000) == 1;
  close(descriptor);
  return ended;
}

std::string folders_of_this_process() {
  std::string names;
  for (const auto& entry : std::filesystem::directory_iterator(session::home_in_memory())) {
    const std::string name = entry.path().filename();
    if (name.find("-" + std::to_string(getpid()) + "-") != std::string::npos) names += name + " ";
  }
  return names;
}

// A process of the engine, of its status.
struct Victim {
  const char* name;
  std::function<int(const v1::StatusReply&)> process;
  int signal;
};

class Deaths : public testing::TestWithParam<Victim> {};

// 300 moves of corners, in whose middle it dies: every one is known to the next engine, and the numbers that
// were told are those of an extraction of everything.
TEST_P(Deaths, NoMoveOfAStreamIsLost) {
  const ScratchFolder folder;
  const auto path = folder / "p.footwall";
  const std::string volume = tasks::new_synthetic_project(path, "faulted", {40, 36, 32}, 3, 4, {}).checksum;
  session::LaunchOptions launch;
  launch.ranks = 2;
  launch.engine = FOOTWALL_ENGINE;
  std::vector<int> processes;
  {
    LocalEngine engine(launch, [&](EngineClient& client) {
      project::Project project = project::Project::open(path, project::OpenMode::kRead);
      tasks::replay_project(project, client, {});
    });
    const v1::StatusReply before = engine.client()->status();
    for (const v1::RankStatus& rank : before.each_rank()) processes.push_back(rank.process());
    processes.push_back(parent_of(processes.front()));
    processes.push_back(parent_of(processes.back()));
    std::vector<extract::Face> faces = faces_from(engine.client()->model());
    ASSERT_GT(faces.size(), 10U);

    Numbers told;
    std::uint64_t newest = 0;
    v1::ExtractOptions options;
    for (const char* name : {"count", "mean", "variance", "min"}) options.add_compute(name);
    const auto live = engine.live(volume, options, [&](const v1::LiveReply& reply) {
      EXPECT_FALSE(reply.has_failure()) << reply.failure().message();
      take(reply.numbers(), told);
      newest = reply.edit();
    });
    for (std::size_t n = 1; n <= 300; ++n) {
      extract::Face& face = faces[n % faces.size()];
      face.triangle[n % 3].i += n % 2 == 0 ? 100 : -90;
      v1::EditBatch batch;
      *batch.add_edits()->mutable_put() = message_of(std::span<const extract::Face>(&face, 1));
      live->send(batch);
      if (n == 150) kill(GetParam().process(before), GetParam().signal);
    }
    live->finish();
    EXPECT_EQ(newest, 300U);
    EXPECT_EQ(engine.starts(), 2);

    EXPECT_EQ(faces_from(engine.client()->model()), faces);
    Numbers whole;
    v1::ExtractRequest request;
    request.set_volume(volume);
    *request.mutable_options() = options;
    engine.with_engine([&](EngineClient& client) {
      client.extract(request, [&](const v1::FaceNumbers& numbers) { take(numbers, whole); }, {});
    });
    EXPECT_EQ(whole.size(), faces.size());
    EXPECT_EQ(told.size(), std::min<std::size_t>(300, faces.size()));
    for (const auto& [face, numbers] : told) EXPECT_EQ(whole.at(face), numbers);
  }
  for (const int process : processes) EXPECT_TRUE(ends(process)) << process;
  EXPECT_EQ(folders_of_this_process(), "");
}

INSTANTIATE_TEST_SUITE_P(
    All, Deaths,
    testing::Values(
        Victim{"Rank0", [](const v1::StatusReply& status) { return status.process(); }, SIGKILL},
        Victim{"Rank1", [](const v1::StatusReply& status) { return status.each_rank(1).process(); }, SIGKILL},
        Victim{"Launcher", [](const v1::StatusReply& status) { return parent_of(status.process()); },
               SIGKILL},
        Victim{"Keeper", [](const v1::StatusReply& status) { return parent_of(parent_of(status.process())); },
               SIGKILL},
        Victim{"Hang", [](const v1::StatusReply& status) { return status.process(); }, SIGSTOP}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace footwall::service
