#include "engine/service/client/engine_process.h"

#include <signal.h>
#include <sys/random.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/service/client/engine_client.h"
#include "engine/service/words_on_the_wire.h"
#include "engine/session/child.h"
#include "engine/session/private_folder.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kKeptLines = 12;
constexpr std::chrono::minutes kPatience{2};
constexpr std::chrono::seconds kTimeToEnd{5};
constexpr int kLookMilliseconds = 50;

std::string listen_words(const std::string& listen, const std::filesystem::path& folder) {
  std::string words = listen == "unix" ? "unix:" + (folder / "engine.sock").string() : listen;
  const std::string path = words.starts_with("unix:") ? words.substr(5) : "";
  if (path.size() >= sizeof sockaddr_un::sun_path) {
    throw Error(ErrorCode::kUsage, "the socket's path is too long: " + path,
                "give --listen unix:PATH with a path of at most 107 characters");
  }
  return words;
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 32> bytes;
  std::size_t length = 0;
  while (length < bytes.size()) {
    const ssize_t got = getrandom(bytes.data() + length, bytes.size() - length, 0);
    if (got < 0 && errno != EINTR) throw io_error("read", "random bytes", errno);
    if (got > 0) length += static_cast<std::size_t>(got);
  }
  std::string digits;
  for (const unsigned char byte : bytes) {
    for (const unsigned half : {byte / 16U, byte % 16U}) digits += "0123456789abcdef"[half];
  }
  return digits;
}

struct EngineProcess::State {
  explicit State(EngineProcessOptions asked) : options(std::move(asked)), folder(session::home_in_memory()) {
    if (options.token.empty()) options.token = random_token();
    std::vector<std::string> words{"serve", "--listen", listen_words(options.listen, folder.path()),
                                   "--folder", folder.path().string()};
    if (!options.volumes.empty())
      words.insert(words.end(), {"--volumes", std::filesystem::absolute(options.volumes).string()});
    if (!options.certificates.empty())
      words.insert(words.end(), {"--certificates", options.certificates.string()});
    if (options.launch.threads > 0)
      words.insert(words.end(), {"--threads", std::to_string(options.launch.threads)});
    if (options.memory_bytes > 0)
      words.insert(words.end(), {"--memory", std::to_string(options.memory_bytes)});
    command = session::engine_command(options.launch, words, folder.path());
    session::Belongings belongings = options.belongings;
    belongings.folders.push_back(folder.path());
    command.words = session::kept_command(session::engine_program(options.launch), belongings, kTokenVariable,
                                          command.words);
    command.settings.push_back(std::string(kTokenVariable) + "=" + options.token);
    // The child lives no longer than the thread that started it: one that does nothing else.
    watcher = std::thread([this] { watch(); });
  }
  ~State() {
    stop_asked = true;
    watcher.join();
  }

  void watch() {
    int status = 0;
    try {
      session::Child child(command.words, command.settings);
      std::optional<Clock::time_point> kill_at;
      while (child.read_lines(kLookMilliseconds, [&](const std::string& text) { line(text); })) {
        if (!stop_asked) continue;
        const auto now = Clock::now();
        if (!kill_at) {
          child.signal(kill_asked ? SIGQUIT : SIGTERM);
          kill_at = now + kTimeToEnd;
        } else if (now > *kill_at + kTimeToEnd) {
          child.kill_group();
        } else if (now > *kill_at) {
          child.signal(SIGQUIT);
        }
      }
      status = child.wait();
    } catch (const Error& failure) {
      const std::scoped_lock lock(mutex);
      if (!error) error = failure;
      status = -1;
    }
    const std::scoped_lock lock(mutex);
    ended = status;
    changed.notify_all();
  }

  void line(const std::string& text) {
    // Where mpirun prints first, its words may stand before a rank's line.
    const Json json = text.front() == '{' ? Json::parse(text, nullptr, false) : Json();
    const std::scoped_lock lock(mutex);
    try {
      if (json.is_object() && json.contains("ready")) {
        const Json& facts = json.at("ready");
        Connection made;
        made.address = facts.at("address").get<std::string>();
        made.token = options.token;
        made.certificate = facts.value("certificate", "");
        made.fingerprint = facts.value("fingerprint", "");
        made.host = facts.value("host", "");
        made.process = facts.value("process", 0);
        made.version = facts.value("version", "");
        made.project = options.project;
        ready = made;
        changed.notify_all();
        return;
      }
      if (json.is_object() && json.contains("error")) {
        const Json& facts = json.at("error");
        if (!error)
          error.emplace(error_code_from(facts.value("code", "internal")), facts.value("message", "unknown"),
                        facts.value("hint", ""));
        return;
      }
    } catch (const Json::exception&) {
      // Not a line of ours: kept as words.
    }
    if (last.size() == kKeptLines) last.pop_front();
    last.push_back(text);
  }

  void end() {
    stop_asked = true;
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return ended.has_value(); });
  }

  std::optional<Connection> serving() const {
    const std::scoped_lock lock(mutex);
    return ended ? std::nullopt : ready;
  }

  std::string words() const {
    std::string text;
    for (const std::string& each : last) text += (text.empty() ? "" : " | ") + each;
    return text;
  }

  EngineProcessOptions options;
  session::PrivateFolder folder;
  session::EngineCommand command;
  std::atomic<bool> stop_asked{false};
  std::atomic<bool> kill_asked{false};
  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  std::optional<Connection> ready;
  std::optional<Error> error;
  std::optional<int> ended;
  std::deque<std::string> last;
  std::thread watcher;
};

EngineProcess::EngineProcess(EngineProcessOptions options)
    : state_(std::make_unique<State>(std::move(options))) {}

EngineProcess::~EngineProcess() {
  stop();
}

Connection EngineProcess::wait_until_ready(const JobContext& job) {
  const auto end = Clock::now() + kPatience;
  std::unique_lock lock(state_->mutex);
  while (!state_->ready && !state_->ended) {
    state_->changed.wait_for(lock, std::chrono::milliseconds(kLookMilliseconds));
    job.check();
    if (Clock::now() > end) {
      throw Error(ErrorCode::kEngine, "the engine did not begin to serve within two minutes",
                  state_->last.empty() ? "footwall doctor tells whether ranks can be started here"
                                       : "its last words: " + state_->words());
    }
  }
  if (state_->ready && !state_->ended) return *state_->ready;
  if (state_->error) throw *state_->error;
  throw Error(ErrorCode::kEngine, "the engine " + session::how_it_ended(*state_->ended),
              state_->last.empty() ? "footwall doctor tells whether ranks can be started here"
                                   : "its last words: " + state_->words());
}

bool EngineProcess::wait_for_end(std::chrono::milliseconds most) const {
  std::unique_lock lock(state_->mutex);
  return state_->changed.wait_for(lock, most, [&] { return state_->ended.has_value(); });
}

bool EngineProcess::ended_well() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->ended && WIFEXITED(*state_->ended) && WEXITSTATUS(*state_->ended) == 0;
}

std::string EngineProcess::last_words() const {
  const std::scoped_lock lock(state_->mutex);
  std::string text = state_->ended ? session::how_it_ended(*state_->ended) : "runs";
  if (state_->error) text += ": " + std::string(state_->error->what());
  const std::string words = state_->words();
  return words.empty() ? text : text + ": " + words;
}

void EngineProcess::stop() {
  if (const auto connection = state_->serving()) {
    // As a client would: a launcher that is told to end kills its ranks before they have tidied up.
    try {
      EngineClient(*connection).shutdown();
      wait_for_end(kTimeToEnd);
    } catch (const Error&) {
      // It does not answer: what follows needs no answer.
    }
  }
  state_->end();
}

void EngineProcess::kill() {
  state_->kill_asked = true;
  state_->end();
}

}  // namespace footwall::service
