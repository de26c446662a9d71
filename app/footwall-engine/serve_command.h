// footwall-engine serve --listen ADDRESS --folder DIR
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/service/resident/resident.h"

namespace footwall::app {

// The engine as a service. Rank 0 has the server; when it answers, one line of JSON on standard error tells
// how to reach it: {"ready": {address, fingerprint, certificate, host, process, ranks}}. SIGTERM, SIGINT and
// a client's Shutdown end it in order: calls are cancelled, the socket is removed.
//
// The token comes from --token-file or the environment's FOOTWALL_ENGINE_TOKEN, which is removed once read.
class ServeCommand {
 public:
  explicit ServeCommand(CLI::App& app);
  bool parsed() const { return command_->parsed(); }
  // Collective; throws Error kUsage, kIo, kEngine (the address is taken), and what Resident throws.
  void run(comm::Communicator& world);

 private:
  CLI::App* command_;
  std::string listen_, token_file_;
  std::filesystem::path certificates_;
  service::ResidentOptions options_;
};

}  // namespace footwall::app
