// Interpolate and Triangulate: what the editor does in its own process, for scripts. No rank takes part: one
// thread of the server does them, in their order.
#pragma once
#include "engine/service/engine.pb.h"
#include "engine/service/server/requests/rank_call.h"

namespace footwall::service {

// The work itself. Throws Error kInvalid, saying what is wrong with the request, and what the library throws.
v1::InterpolateReply interpolate(const v1::InterpolateRequest& request, const JobContext& job);
v1::Triangulation triangulate(const v1::TriangulateRequest& request, const JobContext& job);

class PillarRequest : public RankCall {
 public:
  using RankCall::RankCall;
  void received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) override;
  void no_more() override;
  // Nothing for the ranks.
  v1::Command take_command() override;
  // Does the work, sends the answer and finishes.
  void run() noexcept;

 protected:
  CallQueue& home() override { return services_->pillars; }

 private:
  void answer();
  std::unique_ptr<google::protobuf::Message> request_;
};

// Carries out the queue's calls until it is closed. services.pillars holds nothing else.
void serve_pillars(Services& services);

}  // namespace footwall::service
