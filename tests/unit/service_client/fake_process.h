// The fake engine started as the real one is, under a launcher that is none.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>

#include "engine/service/client/engine_process.h"
#include "engine/session/private_folder.h"

namespace footwall::service {

class FakeProcess : public testing::Test {
 protected:
  FakeProcess() {
    setenv("FOOTWALL_LAUNCHER", "env", 1);
    unsetenv("FAKE_ENGINE_HOW");
  }
  ~FakeProcess() override {
    unsetenv("FOOTWALL_LAUNCHER");
    unsetenv("FAKE_ENGINE_HOW");
  }
  static session::LaunchOptions launch() {
    session::LaunchOptions options;
    options.ranks = 1;
    options.engine = FAKE_ENGINE;
    return options;
  }
  static EngineProcessOptions options() {
    EngineProcessOptions how;
    how.launch = launch();
    return how;
  }
  // Private folders of this process that are there.
  static int folders() {
    int count = 0;
    const std::string own = fmt::format("-{}-", getpid());
    for (const auto& entry : std::filesystem::directory_iterator(session::home_in_memory()))
      count += entry.path().filename().string().find(own) != std::string::npos ? 1 : 0;
    return count;
  }
  static bool is_gone(int process) { return kill(process, 0) != 0; }
};

}  // namespace footwall::service
