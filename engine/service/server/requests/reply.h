// The way back to a client, as requests see it. No RPC in here: the server has it over its streams, tests
// have their own.
#pragma once
#include <google/protobuf/message.h>

#include <optional>

#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::service {

// Any thread may call; each ends on its own, and after the end nothing is sent.
class Reply {
 public:
  virtual ~Reply() = default;
  // One message. Blocks while the client is behind; throws Error kCancelled once it has gone, was too slow,
  // or the job was cancelled.
  virtual void send(const google::protobuf::Message& message, const JobContext& job) = 0;
  // One that may be lost, and is, where the client is behind.
  virtual void hint(const google::protobuf::Message& message) noexcept = 0;
  // The one terminal state. Only the first counts.
  virtual void end(const std::optional<Error>& failure) noexcept = 0;
  // Asks for the client's next message. Not before the former one was received.
  virtual void read_on() noexcept = 0;
};

}  // namespace footwall::service
