// One call over gRPC: bytes from the client go to its request, the request's answer to the client.
//
// What is written waits in an outbox; a writer waits while the outbox is full. A client that takes nothing
// for `patience` is given up, so that it holds neither the dispatcher nor memory.
#pragma once
#include <grpcpp/generic/async_generic_service.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>

#include "engine/service/server/requests/reply.h"
#include "engine/service/server/requests/request.h"

namespace footwall::service {

struct Patience {
  std::chrono::milliseconds reading{5000};   // a client that takes nothing of what is written
  std::chrono::milliseconds asking{30'000};  // one that opens a call and says nothing
};

class Stream final : public grpc::ServerGenericBidiReactor,
                     public Reply,
                     public std::enable_shared_from_this<Stream> {
 public:
  using Clock = std::chrono::steady_clock;

  // done: called at the very end, from any thread. The stream keeps itself until then.
  static std::shared_ptr<Stream> open(grpc::CallbackServerContext& context, const Patience& patience,
                                      std::function<void(const Stream&)> done);
  ~Stream() override = default;

  // Begins to read for the request. Null: there is none, and the caller ends the stream.
  void serve(std::shared_ptr<Request> request);
  // Ends the call, and what is under way for it.
  void drop(const Error& why) noexcept;
  // Gives the client up where its time is over. Called now and then.
  void tick(Clock::time_point now);

  void send(const google::protobuf::Message& message, const JobContext& job) override;
  void hint(const google::protobuf::Message& message) noexcept override;
  void end(const std::optional<Error>& failure) noexcept override;
  void read_on() noexcept override;

 private:
  Stream(grpc::CallbackServerContext& context, const Patience& patience,
         std::function<void(const Stream&)> done);
  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

  void hand_over(Request& asked);
  // Starts what is next: a write, or the finish. Called without the lock.
  void go_on();
  void give_up_locked();
  std::shared_ptr<Request> request();

  const Patience patience_;
  const std::function<void(const Stream&)> done_;
  std::shared_ptr<Stream> self_;

  std::mutex mutex_;
  std::condition_variable changed_;
  grpc::CallbackServerContext* context_;  // null when gRPC is done with the call
  std::shared_ptr<Request> request_;
  grpc::ByteBuffer incoming_;
  grpc::ByteBuffer outgoing_;
  std::deque<grpc::ByteBuffer> outbox_;
  std::size_t outbox_bytes_ = 0;  // with the one under way
  std::optional<grpc::Status> end_;
  bool writing_ = false;
  int asking_ = 0;  // reads on their way to gRPC, which must not finish the call meanwhile
  bool finished_ = false;
  bool asked_ = false;  // the first message came
  Clock::time_point begun_ = Clock::now();
  Clock::time_point last_taken_ = Clock::now();
};

// What a failure is in gRPC's terms.
grpc::StatusCode status_code_of(ErrorCode code);

}  // namespace footwall::service
