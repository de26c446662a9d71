// A call that remembers how it ended.
#pragma once
#include "engine/service/queue/call.h"
#include "engine/service/ranks.pb.h"

namespace footwall::service {

class ToldCall : public Call {
 public:
  using Call::Call;
  v1::Command take_command() override { return {}; }
  void send(const google::protobuf::Message&) override {}
  void finish(const std::optional<Error>& failure) noexcept override {
    outcome_ = failure ? name_of(failure->code()) : "done";
  }
  // "under way", "done", or the name of the error.
  std::string outcome() const { return std::string(outcome_); }

  std::vector<State> told;

 protected:
  void progressed(const State& state) override { told.push_back(state); }

 private:
  std::string_view outcome_ = "under way";
};

}  // namespace footwall::service
