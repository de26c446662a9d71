// How a command answers.
#pragma once
#include <google/protobuf/message.h>

#include <functional>

namespace footwall::service {

// Takes messages for the client on rank 0; on the others they are dropped. Throws Error kCancelled where the
// client has gone: inside collectively(), like any failure of one rank.
using Send = std::function<void(const google::protobuf::Message&)>;

}  // namespace footwall::service
