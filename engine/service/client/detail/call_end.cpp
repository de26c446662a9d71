#include "engine/service/client/detail/call_end.h"

#include "engine/service/engine.pb.h"
#include "engine/service/words_on_the_wire.h"

namespace footwall::service {
namespace {

Error plain_error_of(const grpc::Status& status) {
  switch (status.error_code()) {
    case grpc::StatusCode::CANCELLED:
      // Not by this program, which knows what it cancels, nor as a job, which is told with the failure.
      return {ErrorCode::kEngine, "the engine ends", "start it again with footwall serve"};
    case grpc::StatusCode::UNAUTHENTICATED:
      return {ErrorCode::kInvalid, "the engine does not know this token",
              "use the connection file of the engine that runs now"};
    case grpc::StatusCode::UNAVAILABLE:
      if (status.error_message().find("keepalive") != std::string::npos) return silent_engine();
      return {ErrorCode::kEngine, "the engine has ended",
              "start it again where it ran, with footwall serve, and run this again"};
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return silent_engine();
    case grpc::StatusCode::UNIMPLEMENTED:
      return {ErrorCode::kUnsupported, "the engine does not have this call: " + status.error_message(),
              "use a Footwall of the same version as the engine"};
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return {ErrorCode::kMemory, "too much for the engine: " + status.error_message(),
              "ask for less at once, or try again later"};
    default:
      return {ErrorCode::kEngine, "the engine failed: " + status.error_message()};
  }
}

}  // namespace

Error silent_engine() {
  return {ErrorCode::kEngine, "the engine does not answer: it hangs, or the way to it is broken",
          "footwall status tells whether it is there; end it and start it again if it is not"};
}

Error error_of(const grpc::Status& status, const grpc::ClientContext& context) {
  const auto& trailer = context.GetServerTrailingMetadata();
  const auto found = trailer.find(kFailureMetadata);
  v1::Failure failure;
  if (found == trailer.end() ||
      !failure.ParseFromArray(found->second.data(), static_cast<int>(found->second.size()))) {
    return plain_error_of(status);
  }
  return {error_code_from(failure.code()), failure.message(), failure.hint()};
}

void throw_unless_ok(const grpc::Status& status, const grpc::ClientContext& context) {
  if (!status.ok()) throw error_of(status, context);
}

}  // namespace footwall::service
