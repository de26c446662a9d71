#include "engine/service/server/detail/refusal.h"

#include <vector>

namespace footwall::service {

class Refusals::Refused final : public grpc::ServerGenericBidiReactor {
 public:
  Refused(Refusals& all, std::uint64_t order) : all_(all), order_(order) {}
  // Once, by whoever took it from those that wait.
  void answer() { Finish({grpc::StatusCode::UNAUTHENTICATED, "this needs the engine's token"}); }

 private:
  void OnDone() override { delete this; }
  void OnCancel() override { all_.gone(order_); }
  Refusals& all_;
  const std::uint64_t order_;
};

grpc::ServerGenericBidiReactor* Refusals::refuse() {
  Refused* refused = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    refused = new Refused(*this, ++last_);  // gRPC's reactors own themselves: see OnDone()
    if (!closed_ && (!waiting_.empty() || !rate_.allows())) {
      waiting_.emplace(last_, refused);
      return refused;
    }
  }
  refused->answer();
  return refused;
}

void Refusals::tick() {
  std::vector<Refused*> due;
  {
    const std::scoped_lock lock(mutex_);
    while (!waiting_.empty() && rate_.allows()) {
      due.push_back(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
    }
  }
  for (Refused* one : due) one->answer();
}

void Refusals::gone(std::uint64_t order) {
  Refused* one = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    const auto at = waiting_.find(order);
    if (at == waiting_.end()) return;
    one = at->second;
    waiting_.erase(at);
  }
  one->answer();
}

void Refusals::close() {
  std::map<std::uint64_t, Refused*> due;
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    due.swap(waiting_);
  }
  for (const auto& [order, one] : due) one->answer();
}

}  // namespace footwall::service
