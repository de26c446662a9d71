// The fake engine as a program, started as footwall-engine is: serve --listen ADDRESS ... A file "how" in the
// working folder says what goes wrong: "never" it does not begin to serve, "error" it ends with an error,
// "words" with words.
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/session/keeper.h"
#include "unit/service_client/fake_engine.h"

namespace {

volatile sig_atomic_t stopped = 0;
void stop(int) {
  stopped = 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<char* const> arguments(argv, static_cast<std::size_t>(argc));
  if (footwall::session::is_keeper(arguments)) return footwall::session::keep(arguments);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGTERM, stop);
  std::string listen;
  for (int n = 1; n + 1 < argc; ++n) {
    if (std::string(argv[n]) == "--listen") listen = argv[n + 1];
  }
  const char* token = std::getenv(footwall::service::kTokenVariable);
  const char* how_variable = std::getenv("FAKE_ENGINE_HOW");
  const std::string how = how_variable != nullptr ? how_variable : "";
  if (how == "error") {
    std::fputs("{\"error\": {\"code\": \"io\", \"message\": \"cannot listen\", \"hint\": \"mend it\"}}\n",
               stderr);
    return 1;
  }
  if (how == "words") {
    std::fputs("there is no library\n", stderr);
    return 3;
  }
  if (listen.empty() || token == nullptr) return 2;
  footwall::service::FakeEngine engine(token);
  grpc::ServerBuilder builder;
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
                             footwall::service::kShortestPingMilliseconds);
  builder.AddListeningPort(listen, grpc::InsecureServerCredentials());
  builder.RegisterService(&engine);
  const auto server = builder.BuildAndStart();
  if (!server) return 1;
  std::fputs("words of mpirun\n", stderr);
  if (how != "never") {
    const nlohmann::json ready{
        {"ready", {{"address", listen}, {"host", "here"}, {"process", getpid()}, {"ranks", 1}}}};
    std::fputs((ready.dump() + "\n").c_str(), stderr);
  }
  if (how == "dies") raise(SIGKILL);
  while (stopped == 0 && !engine.stopped) usleep(2000);
  server->Shutdown(std::chrono::system_clock::now());
  return 0;
}
