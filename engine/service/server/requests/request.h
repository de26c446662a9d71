// What a client asks, from its first byte on.
#pragma once
#include <google/protobuf/io/zero_copy_stream.h>

#include <cstdint>
#include <memory>

namespace footwall::service {

// The server calls received() and no_more() one after the other, left() at any time and from any thread. An
// Error that received() or no_more() throws is the call's end.
class Request {
 public:
  virtual ~Request() = default;
  // A message of the client's. Another comes only where Reply::read_on() asks for it.
  virtual void received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) = 0;
  // The client has said all.
  virtual void no_more() = 0;
  // The client has gone, or the call has ended otherwise.
  virtual void left() noexcept = 0;
};

}  // namespace footwall::service
