#include "engine/service/server/requests/rank_call.h"

#include <fmt/format.h>

#include "engine/service/engine.pb.h"
#include "engine/service/server/requests/failure.h"
#include "engine/service/server/requests/parcel.h"

namespace footwall::service {
namespace {

constexpr std::int64_t kMostWaitingBytes = std::int64_t{1} << 30;

}  // namespace

std::unique_ptr<google::protobuf::Message> new_message(const google::protobuf::Descriptor& type) {
  return std::unique_ptr<google::protobuf::Message>(
      google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->New());
}

RankCall::RankCall(const google::protobuf::MethodDescriptor& method, std::shared_ptr<Services> services,
                   std::shared_ptr<Reply> reply)
    : Call(method.name()), method_(method), services_(std::move(services)), reply_(std::move(reply)) {}

RankCall::~RankCall() {
  forget();
}

void RankCall::send(const google::protobuf::Message& message) {
  require(message.GetDescriptor() == method_.output_type(), "a reply of the method's type");
  reply_->send(message, context());
  ++sent_;
}

void RankCall::finish(const std::optional<Error>& failure) noexcept {
  forget();
  // Without its one message the client could make nothing of success.
  if (!failure && !method_.server_streaming() && sent_ != 1) {
    reply_->end(Error(ErrorCode::kInternal, fmt::format("{} ended with {} answers", what(), sent_.load())));
  } else {
    reply_->end(failure);
  }
}

void RankCall::left() noexcept {
  home().cancel(*this);
}

void RankCall::progressed(const State& state) {
  const google::protobuf::FieldDescriptor* field = method_.output_type()->FindFieldByName("progress");
  if (field == nullptr || field->message_type() != v1::Progress::descriptor()) return;
  v1::Progress progress;
  progress.set_fraction(state.fraction);
  progress.set_phase(utf8_of(state.phase));
  progress.set_amounts(utf8_of(state.amounts));
  const auto message = new_message(*method_.output_type());
  message->GetReflection()->MutableMessage(message.get(), field)->CopyFrom(progress);
  reply_->hint(*message);
}

std::int64_t RankCall::unpack(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size,
                              google::protobuf::Message& into) {
  const Parcel parcel(bytes, size, *into.GetDescriptor());
  remember(parcel.memory_bytes());
  parcel.unpack(into);
  return parcel.memory_bytes();
}

void RankCall::remember(std::int64_t bytes) {
  remembered_ += bytes;
  if (services_->waiting_bytes.fetch_add(bytes) + bytes <= kMostWaitingBytes) return;
  throw Error(ErrorCode::kMemory, "the calls that wait for the engine hold too much already",
              "wait for some of them, or cancel them");
}

void RankCall::give_back(std::int64_t bytes) noexcept {
  remembered_ -= bytes;
  services_->waiting_bytes -= bytes;
}

void RankCall::forget() noexcept {
  services_->waiting_bytes -= remembered_.exchange(0);
}

}  // namespace footwall::service
