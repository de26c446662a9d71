// Calls that nobody waits for any more, and that gRPC has not let go of: a call is held while a write of it
// stands before a socket that a hung engine does not empty, cancelled or not. It goes when the engine has
// been ended.
#pragma once
#include <memory>

namespace footwall::service {

class LeftCall {
 public:
  virtual ~LeftCall() = default;
  // No callback of gRPC comes any more.
  virtual bool is_over() const = 0;
};

// Until it is over: those that are go at the next call of this, on the thread that calls. (Not in gRPC's last
// callback: what they hold of gRPC's waits for its threads.)
void keep_until_over(std::unique_ptr<LeftCall> call);

}  // namespace footwall::service
