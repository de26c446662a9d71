// How a call to an engine begins and ends.
#pragma once
#include <grpcpp/grpcpp.h>

#include <string>

#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::service {

// What a call that did not end well says: the engine's own Error where it sent one; else kInvalid
// for a token that it does not know, and kEngine where it is gone or ends.
Error error_of(const grpc::Status& status, const grpc::ClientContext& context);
// Of an engine that is there, as far as one can tell, and says nothing.
Error silent_engine();
void throw_unless_ok(const grpc::Status& status, const grpc::ClientContext& context);

}  // namespace footwall::service
