// A server with ranks of its own making, and a client's stub for it: what tests of the service talk to.
#pragma once
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <thread>

#include "engine/service/engine.grpc.pb.h"
#include "engine/service/ranks.pb.h"
#include "engine/service/server/server.h"
#include "engine/service/words_on_the_wire.h"
#include "scratch_folder.h"

namespace footwall::service {

inline const std::string kToken = "0123456789abcdef0123456789abcdef";

// Waits until something is so, at most a minute.
template <class Condition>
bool eventually(const Condition& condition) {
  const auto last = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > last) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// A gate that commands wait at, so that a test says when they go on. A cancelled one goes on at once.
class Gate {
 public:
  void wait(const Call& call) {
    ++waiting_;
    while (!open_ && !call.context().cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --waiting_;
    call.context().check();
  }
  void open() { open_ = true; }
  bool is_reached() const { return waiting_ > 0; }

 private:
  std::atomic<bool> open_{false};
  std::atomic<int> waiting_{0};
};

// In the place of rank 0's main thread: takes calls and answers as it is told.
class StandInRanks {
 public:
  using Work = std::function<void(const v1::Command&, Call&)>;
  StandInRanks(CallQueue& queue, Work work)
      : queue_(queue), work_(std::move(work)), thread_([this] { serve(); }) {}
  ~StandInRanks() {
    queue_.close(Error(ErrorCode::kEngine, "the engine ends"));
    thread_.join();
  }
  StandInRanks(const StandInRanks&) = delete;
  StandInRanks& operator=(const StandInRanks&) = delete;
  int served() const { return served_; }

 private:
  void serve() {
    while (const std::shared_ptr<Call> call = queue_.next()) {
      std::optional<Error> failure;
      try {
        call->context().check();
        work_(call->take_command(), *call);
      } catch (const Error& error) {
        failure = error;
      }
      ++served_;
      call->finish(failure);
      queue_.done();
    }
  }

  CallQueue& queue_;
  Work work_;
  std::atomic<int> served_{0};
  std::thread thread_;
};

struct EngineAtWork {
  explicit EngineAtWork(StandInRanks::Work work = {}, ServerLimits limits = {},
                        std::size_t most_waiting = 256, const std::string& listen = {})
      : queue(most_waiting), ranks(queue, std::move(work)) {
    ServerOptions options;
    options.listen = listen.empty() ? "unix:" + (folder / "socket").string() : listen;
    options.token = kToken;
    options.certificates = folder / "certificates";
    options.scratch = folder / "scratch";
    options.version = "1.2.3";
    options.limits = limits;
    server = std::make_unique<Server>(
        options, queue, [this] { return status; }, [this] { ++shutdowns; });
    stub = v1::Engine::NewStub(channel());
  }

  std::shared_ptr<grpc::Channel> channel() const {
    grpc::ChannelArguments arguments;
    arguments.SetInt("grpc.use_local_subchannel_pool", 1);  // a connection of its own
    arguments.SetMaxReceiveMessageSize(-1);
    const std::string address = server->address();
    if (address.starts_with("unix:"))
      return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
    arguments.SetSslTargetNameOverride(kCertificateName);
    grpc::SslCredentialsOptions options;
    options.pem_root_certs = server->certificate();
    return grpc::CreateCustomChannel(address.substr(4), grpc::SslCredentials(options), arguments);
  }

  ScratchFolder folder;
  CallQueue queue;
  ResidentStatus status;
  std::atomic<int> shutdowns{0};
  StandInRanks ranks;
  std::unique_ptr<Server> server;  // ends before the ranks do
  std::unique_ptr<v1::Engine::Stub> stub;
};

// A call's context, with the token and a deadline that says "hangs" rather than letting the test hang.
struct Context : grpc::ClientContext {
  explicit Context(const std::string& token = kToken) {
    if (!token.empty()) AddMetadata("footwall-token", token);
    set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(1));
  }
  v1::Failure failure() const {
    v1::Failure failure;
    const auto found = GetServerTrailingMetadata().find("footwall-error-bin");
    if (found != GetServerTrailingMetadata().end())
      failure.ParseFromArray(found->second.data(), static_cast<int>(found->second.size()));
    return failure;
  }
};

}  // namespace footwall::service
