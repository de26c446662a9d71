#include "engine/service/server/requests/queued_request.h"

#include <fmt/format.h>

namespace footwall::service {
namespace {

const google::protobuf::FieldDescriptor* command_of(const google::protobuf::Descriptor& type) {
  const google::protobuf::OneofDescriptor& kinds = *v1::Command::descriptor()->FindOneofByName("what");
  for (int n = 0; n < kinds.field_count(); ++n) {
    if (kinds.field(n)->message_type() == &type) return kinds.field(n);
  }
  return nullptr;
}

}  // namespace

bool is_command(const google::protobuf::Descriptor& type) {
  return command_of(type) != nullptr;
}

QueuedRequest::QueuedRequest(const google::protobuf::MethodDescriptor& method,
                             std::shared_ptr<Services> services, std::shared_ptr<Reply> reply, Turn turn)
    : RankCall(method, std::move(services), std::move(reply)), turn_(turn) {
  require(is_command(*method.input_type()), "a request that is a command");
}

void QueuedRequest::received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) {
  unpack(bytes, size,
         *command_.GetReflection()->MutableMessage(&command_, command_of(*method_.input_type())));
  if (turn_ == Turn::kBetweenSlices) {
    services_->queue.push_read(shared_from_this());
  } else {
    services_->queue.push(shared_from_this());
  }
}

void QueuedRequest::no_more() {
  throw Error(ErrorCode::kInvalid, fmt::format("the call has no {}", method_.input_type()->name()));
}

v1::Command QueuedRequest::take_command() {
  command_.set_job(id());
  return std::move(command_);
}

}  // namespace footwall::service
