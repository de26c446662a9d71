#include "app/footwall-engine/serve_command.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/footwall-engine/running_job.h"
#include "engine/service/server/private_folder.h"
#include "engine/service/server/server.h"
#include "engine/service/words_on_the_wire.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::app {
namespace {

using service::kTokenVariable;
constexpr std::size_t kLongestToken = 4096;

// Overwritten where it stood, too: the system shows a process's first environment.
std::string token_from_environment() {
  char* const value = ::getenv(kTokenVariable);
  if (value == nullptr) return {};
  std::string token = value;
  std::fill_n(value, token.size(), 'x');
  ::unsetenv(kTokenVariable);
  return token;
}

std::string token_from(const std::string& file, std::string of_environment) {
  if (!file.empty()) return std::string(text::trimmed(read_whole_file(file, kLongestToken)));
  if (of_environment.empty()) {
    throw Error(ErrorCode::kUsage, "the engine has no token",
                std::string("give it in the environment's ") + kTokenVariable + ", or --token-file");
  }
  return of_environment;
}

// What a signal, or a client, ends the engine with: a handler can do no more than write here.
int end_bell = -1;
void ring_end(int /*number*/) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(end_bell, &one, sizeof(one));
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  ::sigaction(number, &action, nullptr);
}

// Closes the queue when the bell rings; at the end it is rung for its own sake.
class EndWatch {
 public:
  explicit EndWatch(service::CallQueue& queue)
      : thread_([&queue] {
          std::uint64_t count = 0;
          while (::read(end_bell, &count, sizeof(count)) < 0 && errno == EINTR) {
          }
          queue.close(Error(ErrorCode::kEngine, "the engine ends", "start it again"));
        }) {}
  ~EndWatch() {
    ring_end(0);
    thread_.join();
  }
  EndWatch(const EndWatch&) = delete;
  EndWatch& operator=(const EndWatch&) = delete;

 private:
  std::thread thread_;
};

void tell_ready(const service::Server& server, const service::ResidentStatus& status) {
  const service::RankFacts& first = status.ranks.front();
  print_line({{"ready",
               {{"address", server.address()},
                {"fingerprint", server.fingerprint()},
                {"certificate", server.certificate()},
                {"host", first.host},
                {"process", first.process},
                {"ranks", status.ranks.size()}}}});
}

}  // namespace

ServeCommand::ServeCommand(CLI::App& app)
    : command_(app.add_subcommand("serve", "the engine as a service; footwall serve starts it")) {
  command_->add_option("--listen", listen_, "unix:PATH or tcp:HOST:PORT; port 0: any")->required();
  command_->add_option("--folder", options_.folder, "private, for sockets, certificate and files under way")
      ->required();
  command_->add_option("--certificates", certificates_,
                       "private, where key and certificate of TLS stay (default: in --folder)");
  command_->add_option("--volumes", options_.volumes, "where volumes are found by checksum");
  command_->add_option("--threads", options_.threads, "of each rank")->check(CLI::Range(1, 4096));
  command_->add_option("--memory", options_.memory_bytes, "bytes of each host (default: what is free there)")
      ->check(CLI::NonNegativeNumber);
  command_->add_option("--token-file", token_file_,
                       std::string("has the token (default: the environment's ") + kTokenVariable + ")");
}

void ServeCommand::run(comm::Communicator& world) {
  std::string of_environment = token_from_environment();
  const bool leads = world.rank() == 0;
  std::string token;
  world.collectively([&] {
    if (leads) token = token_from(token_file_, std::move(of_environment));
    if (leads) service::require_private_folder(options_.folder);
    // Only the first rank ends the engine; the others are told by it.
    if (leads && end_bell < 0) end_bell = ::eventfd(0, EFD_CLOEXEC);
    if (leads && end_bell < 0) throw io_error("make", "an eventfd", errno);
  });
  // On other hosts, where whoever started the engine made none and will remove none.
  const bool made =
      world.collectively([&] { return !leads && service::require_private_folder(options_.folder); });
  for (const int number : {SIGINT, SIGTERM}) handle(number, leads ? ring_end : SIG_IGN);
  handle(SIGPIPE, SIG_IGN);  // whoever started the engine may not listen any longer

  service::Resident resident(world, options_);
  std::error_code ignored;
  if (made) std::filesystem::remove(options_.folder, ignored);  // the sockets in it were for its start
  if (!leads) {
    world.collectively([] {});  // the server of rank 0
    resident.serve(nullptr);
    return;
  }
  service::CallQueue queue;
  std::optional<service::Server> server;
  world.collectively([&] {
    service::ServerOptions how;
    how.listen = listen_;
    how.token = token;
    how.certificates = certificates_.empty() ? options_.folder / "certificate" : certificates_;
    how.scratch = options_.folder / "scratch";
    how.version = FOOTWALL_VERSION;
    server.emplace(
        how, queue, [&resident] { return resident.status(); }, [] { ring_end(0); });
  });
  const EndWatch watch(queue);
  if (told_to_make_room()) ring_end(SIGTERM);  // before anybody listened
  tell_ready(*server, resident.status());
  resident.serve(&queue);
}

}  // namespace footwall::app
