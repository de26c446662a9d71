// Calls without the token. All get one answer, whatever they ask for; where there are many, they get it
// later.
#pragma once
#include <grpcpp/generic/async_generic_service.h>

#include <map>
#include <mutex>

#include "engine/service/server/detail/token.h"

namespace footwall::service {

class Refusals {
 public:
  Refusals(double burst, double per_second) : rate_(burst, per_second) {}

  // The reactor of a refused call; it keeps itself.
  grpc::ServerGenericBidiReactor* refuse();
  // Answers those whose time has come.
  void tick();
  // Answers all of them, and from now on at once.
  void close();

 private:
  class Refused;
  // Its client has gone: it takes no memory any longer.
  void gone(std::uint64_t order);

  FailureRate rate_;
  std::mutex mutex_;
  std::uint64_t last_ = 0;
  std::map<std::uint64_t, Refused*> waiting_;  // by the order in which they came
  bool closed_ = false;
};

}  // namespace footwall::service
