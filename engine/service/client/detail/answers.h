// The two kinds of streams as a thread that waits sees them: messages one after the other, a cancel that is
// looked for all the time, and an end that is always waited for.
//
// gRPC's own threads receive, so that a connection is looked after also while nobody asks for its messages.
#pragma once
#include <grpcpp/grpcpp.h>
#include <grpcpp/support/client_callback.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>

#include "engine/service/client/detail/call_end.h"
#include "engine/service/client/detail/left_calls.h"
#include "engine/service/words_on_the_wire.h"

namespace footwall::service {

// How soon a cancel of the JobContext is seen.
inline constexpr std::chrono::milliseconds kCancelInterval{20};
// How long a cancelled call takes to end where nothing hangs, at most.
inline constexpr std::chrono::milliseconds kTimeToEnd{500};

// What both kinds have in common: one message at a time is received ahead, and kept until asked for. Reactor:
// the gRPC class that receives Replies.
template <class Reactor, class Reply>
class Answers : public Reactor {
 public:
  ~Answers() override = default;
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;

  // The next message; false when there is none, and the call has ended or was cancelled.
  bool next(Reply& to, const JobContext& job) {
    std::unique_lock lock(mutex_);
    heard_ = Clock::now();
    for (;;) {
      if (received_ && !told_) {
        std::swap(to, message_);
        receive();
        return true;
      }
      if (received_) receive();
      if (done_ || told_) return false;
      if (job.cancelled()) tell();
      changed_.wait_for(lock, kCancelInterval);
      look_for_silence(lock);
    }
  }
  // After next() said false. Cancelled by us: kCancelled, whatever the other side made of it.
  void throw_unless_ok() {
    const std::unique_lock lock(mutex_);
    if (silent_) throw silent_engine();
    if (told_) throw Error(ErrorCode::kCancelled, "cancelled");
    service::throw_unless_ok(status_, context_);
  }
  // Nothing more comes.
  bool done() const {
    const std::unique_lock lock(mutex_);
    return done_ || told_;
  }
  void cancel() {
    const std::unique_lock lock(mutex_);
    tell();
  }
  // The call's error, where it has ended with one.
  void throw_if_failed() {
    const std::unique_lock lock(mutex_);
    if (silent_) throw silent_engine();
    if (done_) service::throw_unless_ok(status_, context_);
  }

  void OnReadDone(bool good) override {
    const std::unique_lock lock(mutex_);
    received_ = good;
    if (!good) {
      ended_ = true;
      this->RemoveHold();
    } else if (left_) {
      receive();
    }
    changed_.notify_all();
  }
  void OnDone(const grpc::Status& status) override {
    const std::unique_lock lock(mutex_);
    status_ = status;
    done_ = true;
    changed_.notify_all();
  }

 protected:
  using Clock = std::chrono::steady_clock;

  explicit Answers(grpc::ClientContext& context) : context_(context) {}

  // While the other side takes nothing of what is sent, and sends nothing, it is asked whether it is there.
  void look_for_silence(std::unique_lock<std::mutex>& lock) {
    if (told_ || received_ || !is_held_up(Clock::now() - heard_)) return;
    lock.unlock();
    const bool answers = still_there();
    lock.lock();
    heard_ = Clock::now();
    if (answers || done_) return;
    silent_ = true;
    tell();
  }
  // Whether something that we sent may be held up, after so long without a message: gRPC's own pings are,
  // too, then, and it never says so.
  virtual bool is_held_up(Clock::duration /*quiet*/) { return false; }
  // Asked then, on the thread that waits: whether the other side answers elsewhere.
  virtual bool still_there() { return true; }

  // The call was set up: begins. The hold lets operations begin outside of gRPC's callbacks, until the end of
  // what is received.
  void begin() {
    const std::unique_lock lock(mutex_);
    this->AddHold();
    this->StartRead(&message_);
    this->StartCall();
  }
  // No callback comes any more.
  void end() {
    std::unique_lock lock(mutex_);
    while (!done_) {
      tell();
      if (received_) receive();
      changed_.wait(lock);
    }
  }
  // Cancels the call, if need be; whether its last callback has come, for which this waits a moment.
  bool ends_soon() {
    std::unique_lock lock(mutex_);
    const auto latest = Clock::now() + (silent_ ? Clock::duration(0) : kTimeToEnd);
    while (!done_) {
      tell();
      if (received_) receive();
      if (changed_.wait_until(lock, latest) == std::cv_status::timeout) break;
    }
    left_ = !done_;
    return done_;
  }
  bool has_come_to_an_end() const {
    const std::unique_lock lock(mutex_);
    return done_;
  }
  std::mutex& mutex() { return mutex_; }
  std::condition_variable& changed() { return changed_; }
  bool ended() const { return ended_; }
  void tell() {
    if (!std::exchange(told_, true)) context_.TryCancel();
  }

 private:
  void receive() {
    received_ = false;
    message_.Clear();
    this->StartRead(&message_);
  }

  grpc::ClientContext& context_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Reply message_;
  bool received_ = false;
  bool ended_ = false;   // no message comes any more
  bool told_ = false;    // to cancel
  bool silent_ = false;  // why: nobody answers
  bool left_ = false;    // nobody asks for messages any more
  Clock::time_point heard_ = Clock::now();
  bool done_ = false;
  grpc::Status status_;
};

template <class Reply>
class AnswerStream final : public Answers<grpc::ClientReadReactor<Reply>, Reply> {
 public:
  using Base = Answers<grpc::ClientReadReactor<Reply>, Reply>;
  // start(reactor): hands the call to gRPC.
  template <class Start>
  AnswerStream(grpc::ClientContext& context, const Start& start) : Base(context) {
    start(this);
    this->begin();
  }
  ~AnswerStream() override { this->end(); }
};

template <class Request, class Reply>
class Conversation final : public Answers<grpc::ClientBidiReactor<Request, Reply>, Reply>, public LeftCall {
 public:
  using Base = Answers<grpc::ClientBidiReactor<Request, Reply>, Reply>;
  struct Leave {
    void operator()(Conversation* conversation) const {
      std::unique_ptr<LeftCall> call(conversation);
      if (!conversation->ends_soon()) keep_until_over(std::move(call));
    }
  };
  using Pointer = std::unique_ptr<Conversation, Leave>;

  // channel: which has to be there as long as the call. prepare(context): token and the like. start(context,
  // reactor): hands the call to gRPC. still_there: whether the other side answers a call of its own, which it
  // decides soon.
  template <class Prepare, class Start>
  static Pointer open(std::shared_ptr<grpc::Channel> channel, const Prepare& prepare, const Start& start,
                      std::function<bool()> still_there) {
    auto context = std::make_unique<grpc::ClientContext>();
    prepare(*context);
    Pointer made(new Conversation(std::move(channel), std::move(context), std::move(still_there)));
    start(made->context_.get(), made.get());
    made->begin();
    return made;
  }

  ~Conversation() override = default;
  bool is_over() const override { return this->has_come_to_an_end(); }

  // Puts a message on its way; false where nobody listens any more.
  bool send(Request message) {
    const std::unique_lock lock(this->mutex());
    if (this->ended() || broken_ || last_) return false;
    waiting_.push_back(std::move(message));
    sent_ = true;
    go_on();
    return true;
  }
  // Waits until at most `most` messages are on their way; false where nobody listens any more.
  bool wait_for_room(std::size_t most, const JobContext& job) {
    std::unique_lock lock(this->mutex());
    while (waiting_.size() > most && !this->ended() && !broken_) {
      if (job.cancelled()) this->tell();
      this->changed().wait_for(lock, kCancelInterval);
      this->look_for_silence(lock);
    }
    return !this->ended() && !broken_;
  }
  // Nothing more is sent.
  void send_no_more() {
    const std::unique_lock lock(this->mutex());
    last_ = true;
    go_on();
  }

 protected:
  // A message that gRPC calls written may still stand before a full socket: so it is asked once after
  // everything that was sent, and on and on where the end is waited for.
  bool is_held_up(typename Base::Clock::duration quiet) override {
    if (quiet <= std::chrono::milliseconds(kPingMilliseconds)) return false;
    return std::exchange(sent_, false) || busy_ || last_;
  }
  bool still_there() override { return still_there_(); }

 public:
  void OnWriteDone(bool good) override {
    const std::unique_lock lock(this->mutex());
    waiting_.pop_front();
    busy_ = false;
    broken_ = broken_ || !good;
    go_on();
    this->changed().notify_all();
  }

 private:
  void go_on() {
    if (busy_ || broken_ || this->ended() || closed_) return;
    if (!waiting_.empty()) {
      busy_ = true;
      this->StartWrite(&waiting_.front());
    } else if (last_) {
      closed_ = true;
      this->StartWritesDone();
    }
  }

  Conversation(std::shared_ptr<grpc::Channel> channel, std::unique_ptr<grpc::ClientContext> context,
               std::function<bool()> still_there)
      : Base(*context),
        channel_(std::move(channel)),
        context_(std::move(context)),
        still_there_(std::move(still_there)) {}

  const std::shared_ptr<grpc::Channel> channel_;
  const std::unique_ptr<grpc::ClientContext> context_;
  std::function<bool()> still_there_;
  std::deque<Request> waiting_;  // the first is being sent
  bool sent_ = false;            // since the other side was asked whether it is there
  bool busy_ = false;
  bool broken_ = false;
  bool last_ = false;
  bool closed_ = false;
};

}  // namespace footwall::service
