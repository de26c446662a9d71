#include "engine/service/client/local_engine.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "engine/service/client/detail/call_end.h"
#include "engine/service/client/edit_journal.h"
#include "engine/service/client/engine_process.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostDeaths = 3;
constexpr std::chrono::minutes kDeathsCount{1};
// A client sees a broken connection before the keeper has seen the ranks' end.
constexpr std::chrono::seconds kTimeToDie{1};
// How soon a stream looks whether it has ended.
constexpr std::chrono::milliseconds kLook{20};

}  // namespace

bool DeathCount::add() {
  const auto now = Clock::now();
  while (!deaths_.empty() && now - deaths_.front() > kDeathsCount) deaths_.pop_front();
  deaths_.push_back(now);
  return deaths_.size() < kMostDeaths;
}

struct LocalEngine::State {
  using Client = std::shared_ptr<EngineClient>;

  session::LaunchOptions options;
  Replay replay;
  std::recursive_mutex mutex;  // of all below; a replay may ask for what it likes
  std::unique_ptr<EngineProcess> process;
  Client client;  // null until the replay was done
  Connection reached;
  DeathCount deaths;
  int starts = 0;
  EditJournal journal;
  std::uint64_t newest = 0;  // of the program's edits
  std::uint64_t shift = 0;   // of the program's numbers in this engine, where the replay used some

  bool runs() const { return process && !process->wait_for_end(std::chrono::milliseconds(0)); }

  // What ends an attempt to go on with this engine: counts it, and throws where it was one too many.
  void bury() {
    client.reset();
    if (!process) return;
    process->kill();
    const std::string words = process->last_words();
    process.reset();
    if (deaths.add()) return;
    throw Error(ErrorCode::kEngine, "the engine died three times within a minute",
                "its last words: it " + words);
  }

  void start(const JobContext& job) {
    ++starts;
    EngineProcessOptions how;
    how.launch = options;
    process = std::make_unique<EngineProcess>(how);
    std::optional<Connection> connection;
    try {
      connection = process->wait_until_ready(job);
    } catch (...) {
      process.reset();  // it cannot be started here, and so not a second time
      throw;
    }
    auto fresh = std::make_shared<EngineClient>(*connection);
    reached = *connection;
    if (replay) replay(*fresh);
    for (const v1::EditBatch& batch : journal.batches()) fresh->edit(batch);
    shift = fresh->status().edit();
    client = std::move(fresh);
  }

  Client running(const JobContext& job) {
    const std::scoped_lock lock(mutex);
    for (;;) {
      job.check();
      if (client && runs()) return client;
      bury();
      try {
        start(job);
      } catch (const Error& error) {
        if (!process) throw;
        if (died(error, nullptr)) continue;  // in the middle of the replay
        process.reset();
        throw;
      }
    }
  }

  // Whether an error of a call of this client comes from the engine's end, which is seen to then.
  bool died(const Error& error, const Client& of) {
    if (error.code() != ErrorCode::kEngine) return false;
    const std::scoped_lock lock(mutex);
    if (client != of) return true;  // somebody has seen to it
    // One that was silent for so long is not asked again: it would answer calls whose edits it may have.
    const bool silent = error.message() == silent_engine().message();
    if (!silent && process && !process->wait_for_end(kTimeToDie)) {
      try {
        if (client) {
          client->status();
          return false;
        }
      } catch (const Error&) {
        // It is gone, or hangs.
      }
    }
    bury();
    return true;
  }

  // The number of an edit, which is its own or the next.
  std::uint64_t number(const v1::EditBatch& batch) {
    const std::scoped_lock lock(mutex);
    newest = batch.edit() == 0 ? newest + 1 : std::max(newest, batch.edit());
    return batch.edit() == 0 ? newest : batch.edit();
  }
};

// One stream to the program, one after the other to engines.
class LocalEngine::Steady final : public EngineClient::LiveStream {
 public:
  Steady(State& engine, std::string volume, v1::ExtractOptions options,
         std::function<void(const v1::LiveReply&)> answer)
      : engine_(engine),
        volume_(std::move(volume)),
        options_(std::move(options)),
        answer_(std::move(answer)) {
    open();
    thread_ = std::thread([this] { watch(); });
  }
  ~Steady() override {
    job_.cancel();
    thread_.join();
    stream_.reset();
    keep_answered();
  }

  void send(const v1::EditBatch& batch) override {
    const std::scoped_lock lock(mutex_);
    if (failed_) std::rethrow_exception(failed_);
    v1::EditBatch numbered = batch;
    numbered.set_edit(engine_.number(batch));
    unanswered_.push_back(numbered);
    if (!stream_ || stream_->has_ended()) return;  // the next one is told
    numbered.set_edit(numbered.edit() + shift_);
    stream_->offer(numbered);
  }
  bool offer(const v1::EditBatch& batch) override {
    if (has_ended()) return false;
    send(batch);
    return true;
  }
  bool has_ended() const override {
    const std::scoped_lock lock(mutex_);
    return failed_ || over_;
  }
  void finish() override {
    {
      std::unique_lock lock(mutex_);
      last_ = true;
      changed_.wait(lock, [&] { return over_ || failed_; });
      if (failed_) std::rethrow_exception(failed_);
    }
    keep_answered();
  }

 private:
  // To an engine that is there, or is started. It is told all that was not answered.
  void open() {
    const State::Client client = engine_.running(job_);
    const std::scoped_lock lock(mutex_);
    stream_.reset();
    client_ = client;
    {
      const std::scoped_lock numbers(engine_.mutex);
      shift_ = engine_.shift;
    }
    stream_ = client_->live(volume_, options_, [this](const v1::LiveReply& reply) { take(reply); });
    for (v1::EditBatch batch : unanswered_) {
      batch.set_edit(batch.edit() + shift_);
      stream_->offer(batch);
    }
  }

  // On the stream's thread.
  void take(const v1::LiveReply& reply) {
    v1::LiveReply own = reply;
    {
      const std::scoped_lock lock(answered_mutex_);
      own.set_edit(reply.edit() - std::min(reply.edit(), shift_.load()));
      if (reply.has_failure()) {
        refused_.push_back(own.edit());
      } else {
        answered_ = own.edit();
      }
    }
    answer_(own);
  }

  // What was answered is the journal's, but for the newest: more of its answer may come.
  void keep(bool also_newest) {
    const std::scoped_lock lock(mutex_, answered_mutex_, engine_.mutex);
    while (!unanswered_.empty()) {
      const v1::EditBatch& first = unanswered_.front();
      const bool refused = std::find(refused_.begin(), refused_.end(), first.edit()) != refused_.end();
      if (!refused && (first.edit() > answered_ || (first.edit() == answered_ && !also_newest))) break;
      if (!refused) engine_.journal.add(first);
      std::erase(refused_, first.edit());
      unanswered_.pop_front();
    }
  }
  void keep_answered() { keep(true); }

  void watch() {
    try {
      while (!job_.cancelled() && !step()) {
      }
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      failed_ = std::current_exception();
    }
    changed_.notify_all();
  }

  // Whether it is over.
  bool step() {
    keep(false);
    bool last = false;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, kLook);
      last = last_;
      if (!last && !stream_->has_ended()) return false;
    }
    // Nobody else ends it, and send() does no harm.
    try {
      stream_->finish();
      if (!last) throw Error(ErrorCode::kEngine, "the engine has ended the stream of edits");
      const std::scoped_lock lock(mutex_);
      over_ = true;
      return true;
    } catch (const Error& error) {
      keep(false);
      if (job_.cancelled() || !engine_.died(error, client_)) throw;
    }
    open();
    return false;
  }

  State& engine_;
  std::string volume_;
  v1::ExtractOptions options_;
  std::function<void(const v1::LiveReply&)> answer_;
  JobContext job_;
  mutable std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  State::Client client_;
  std::unique_ptr<EngineClient::LiveStream> stream_;
  std::deque<v1::EditBatch> unanswered_;
  bool last_ = false;
  bool over_ = false;
  std::exception_ptr failed_;
  std::mutex answered_mutex_;  // of what follows: the stream's thread must never wait for a sender
  std::atomic<std::uint64_t> shift_{0};
  std::uint64_t answered_ = 0;
  std::vector<std::uint64_t> refused_;
  std::thread thread_;
};

LocalEngine::LocalEngine(session::LaunchOptions options, Replay replay) : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  state_->replay = std::move(replay);
}

LocalEngine::~LocalEngine() = default;

std::shared_ptr<EngineClient> LocalEngine::client(const JobContext& job) {
  return state_->running(job);
}

void LocalEngine::with_engine(const std::function<void(EngineClient&)>& f, const JobContext& job) {
  for (;;) {
    const State::Client client = state_->running(job);
    try {
      f(*client);
      return;
    } catch (const Error& error) {
      if (!state_->died(error, client)) throw;
    }
  }
}

v1::EditModelReply LocalEngine::edit(const v1::EditBatch& batch, const JobContext& job) {
  v1::EditBatch numbered = batch;
  v1::EditModelReply reply;
  const std::uint64_t number = state_->number(batch);
  with_engine(
      [&](EngineClient& client) {
        {
          const std::scoped_lock lock(state_->mutex);
          numbered.set_edit(number + state_->shift);
        }
        reply = client.edit(numbered);
        reply.set_edit(number);
        const std::scoped_lock lock(state_->mutex);
        state_->journal.add(numbered);
      },
      job);
  return reply;
}

std::unique_ptr<EngineClient::LiveStream> LocalEngine::live(
    const std::string& volume, const v1::ExtractOptions& options,
    std::function<void(const v1::LiveReply&)> answer) {
  return std::make_unique<Steady>(*state_, volume, options, std::move(answer));
}

void LocalEngine::forget_edits() {
  const std::scoped_lock lock(state_->mutex);
  state_->journal.clear();
}

bool LocalEngine::is_running() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->runs();
}

Connection LocalEngine::connection() const {
  const std::scoped_lock lock(state_->mutex);
  if (!state_->client) throw Error(ErrorCode::kEngine, "no engine runs");
  return state_->reached;
}

int LocalEngine::starts() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->starts;
}

}  // namespace footwall::service
