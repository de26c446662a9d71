#include "engine/tasks/serve.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <optional>

#include "engine/service/client/local_engine.h"
#include "engine/session/private_folder.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{50};

// The one who serves: ends with the process, however that ends.
class ServeLock {
 public:
  ServeLock(const std::filesystem::path& connection, const std::string& what)
      : path_(connection.string() + ".lock") {
    for (;;) {
      file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
      if (file_ < 0) throw io_error("open", path_, errno);
      const bool locked = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
      struct stat facts {};
      // One who ended in between has removed the file that we have opened.
      const bool stands = ::fstat(file_, &facts) == 0 && facts.st_nlink > 0;
      if (locked && stands) return;
      ::close(file_);
      if (!locked) break;
    }
    std::string who;
    try {
      const service::Connection there = service::read_connection(connection);
      who =
          " by process " + std::to_string(there.process) + " on host " + there.host + ", at " + there.address;
    } catch (const Error&) {
      who = " by an engine that is being started";
    }
    throw Error(ErrorCode::kHeld, what + " is served already" + who,
                "use that one (footwall status tells what it does), or end it with footwall stop");
  }
  ~ServeLock() {
    ::unlink(path_.c_str());
    ::close(file_);
  }
  ServeLock(const ServeLock&) = delete;
  ServeLock& operator=(const ServeLock&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_ = -1;
};

// There only while the engine serves.
class ConnectionOnDisk {
 public:
  explicit ConnectionOnDisk(std::filesystem::path path) : path_(std::move(path)) {}
  ~ConnectionOnDisk() { remove(); }
  ConnectionOnDisk(const ConnectionOnDisk&) = delete;
  ConnectionOnDisk& operator=(const ConnectionOnDisk&) = delete;
  void write(const service::Connection& connection) { service::write_connection(connection, path_); }
  void remove() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

 private:
  std::filesystem::path path_;
};

class Serving {
 public:
  Serving(const ServeOptions& options, const ServeEvents& events, const JobContext& job)
      : options_(options), events_(events), job_(job), home_(session::home_in_memory()) {
    done_.file = options.connection.empty() ? service::default_connection_file(options.project)
                                            : std::filesystem::absolute(options.connection);
    engine_ = options.engine;
    engine_.token = service::told_token();
    if (engine_.token.empty()) engine_.token = service::random_token();
    // So that clients can go on after a stop and a start.
    if (engine_.listen.starts_with("tcp:")) engine_.certificates = service::certificate_folder();
    engine_.project = options.project.empty() ? "" : std::filesystem::absolute(options.project).string();
    // The same address after each start.
    if (engine_.listen == "unix") engine_.listen = "unix:" + (home_.path() / "engine.sock").string();
  }

  Served run() {
    const Clock::time_point start = Clock::now();
    // By project, wherever the file is to be.
    const ServeLock lock(
        options_.project.empty() ? done_.file : service::default_connection_file(options_.project),
        options_.project.empty() ? done_.file.string() : options_.project.string());
    ConnectionOnDisk file(done_.file);
    engine_.belongings = {{home_.path()}, done_.file, lock.path()};
    while (!job_.cancelled() && serve_once(file)) {
    }
    done_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    done_.connection.token.clear();
    return done_;
  }

 private:
  // Whether it is to be started again.
  bool serve_once(ConnectionOnDisk& file) {
    ++done_.starts;
    service::EngineProcess process(engine_);
    try {
      done_.connection = process.wait_until_ready(job_);
      // A port that was chosen stays.
      if (engine_.listen.starts_with("tcp:")) engine_.listen = done_.connection.address;
      service::EngineClient client(done_.connection);
      done_.connection.version = client.status().version();
      const Replayed replayed = replay(client);
      file.write(done_.connection);
      if (events_.ready) events_.ready(done_.connection, done_.file, replayed);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kCancelled) return false;
      if (done_.connection.process == 0 || error.code() != ErrorCode::kEngine) throw;
      process.stop();
      return start_again(process);
    }
    while (!process.wait_for_end(kLook)) {
      if (job_.cancelled()) return false;
    }
    file.remove();
    return !process.ended_well() && start_again(process);
  }

  bool start_again(const service::EngineProcess& process) {
    const std::string words = process.last_words();
    if (!deaths_.add()) {
      throw Error(ErrorCode::kEngine, "the engine died three times within a minute",
                  "its last words: it " + words);
    }
    if (events_.died) events_.died(words);
    return true;
  }

  Replayed replay(service::EngineClient& client) const {
    if (options_.project.empty()) return {};
    project::Project project = project::Project::open(options_.project, project::OpenMode::kRead);
    return replay_project(project, client, job_);
  }

  const ServeOptions& options_;
  const ServeEvents& events_;
  const JobContext& job_;
  session::PrivateFolder home_;
  service::EngineProcessOptions engine_;
  service::DeathCount deaths_;
  Served done_;
};

}  // namespace

Served serve(const ServeOptions& options, const ServeEvents& events, const JobContext& job) {
  return Serving(options, events, job).run();
}

}  // namespace footwall::tasks
