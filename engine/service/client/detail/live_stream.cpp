#include "engine/service/client/detail/live_stream.h"

#include <exception>
#include <thread>
#include <utility>

#include "engine/service/client/detail/answers.h"
#include "engine/service/words_on_the_wire.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

class Live final : public EngineClient::LiveStream {
 public:
  Live(const std::shared_ptr<grpc::Channel>& channel, v1::Engine::Stub& stub, const std::string& token,
       v1::LiveRequest first, std::function<void(const v1::LiveReply&)> answer,
       std::function<bool()> still_there)
      : answer_(std::move(answer)),
        talk_(Talk::open(
            channel, [&](grpc::ClientContext& context) { context.AddMetadata(kTokenMetadata, token); },
            [&](grpc::ClientContext* context, auto* reactor) { stub.async()->Live(context, reactor); },
            std::move(still_there))) {
    talk_->send(std::move(first));
    listener_ = std::thread([this] { listen(); });
  }
  ~Live() override {
    if (!listener_.joinable()) return;
    talk_->cancel();
    listener_.join();
  }

  bool offer(const v1::EditBatch& batch) override {
    v1::LiveRequest request;
    *request.mutable_batch() = batch;
    return talk_->send(std::move(request));
  }

  void send(const v1::EditBatch& batch) override {
    if (offer(batch)) return;
    finish();
    throw Error(ErrorCode::kEngine, "the engine has ended the stream of edits", "open another one");
  }

  bool has_ended() const override { return talk_->done(); }

  void finish() override {
    talk_->send_no_more();
    if (listener_.joinable()) listener_.join();
    if (failed_) std::rethrow_exception(failed_);
    talk_->throw_unless_ok();
  }

 private:
  using Talk = Conversation<v1::LiveRequest, v1::LiveReply>;

  void listen() {
    v1::LiveReply reply;
    while (talk_->next(reply, {})) {
      if (failed_) continue;
      try {
        answer_(reply);
      } catch (...) {
        failed_ = std::current_exception();  // thrown to whoever asks next
        talk_->cancel();
      }
    }
  }

  std::function<void(const v1::LiveReply&)> answer_;
  Talk::Pointer talk_;
  std::exception_ptr failed_;
  std::thread listener_;
};

}  // namespace

std::unique_ptr<EngineClient::LiveStream> open_live_stream(const std::shared_ptr<grpc::Channel>& channel,
                                                           v1::Engine::Stub& stub, const std::string& token,
                                                           v1::LiveRequest first,
                                                           std::function<void(const v1::LiveReply&)> answer,
                                                           std::function<bool()> still_there) {
  return std::make_unique<Live>(channel, stub, token, std::move(first), std::move(answer),
                                std::move(still_there));
}

}  // namespace footwall::service
