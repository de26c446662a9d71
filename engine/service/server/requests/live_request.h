// Edits as they are made: gathered until the ranks have time, applied together, answered once.
#pragma once
#include "engine/service/ranks.pb.h"
#include "engine/service/server/requests/rank_call.h"

namespace footwall::service {

class LiveRequest final : public RankCall {
 public:
  using RankCall::RankCall;

  void received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) override;
  void no_more() override;
  void left() noexcept override;
  // All edits that are there.
  v1::Command take_command() override;
  // After success the stream goes on; a failure ends it.
  void finish(const std::optional<Error>& failure) noexcept override;

 private:
  enum class Turn : std::uint8_t { kIdle, kInQueue };
  void take(v1::LiveRequest& message, std::int64_t memory);
  // Into the queue, where edits wait and the call does not. Throws what push() throws.
  void wait_for_turn();

  std::mutex mutex_;
  Turn turn_ = Turn::kIdle;
  bool begun_ = false;
  bool all_said_ = false;
  bool reading_paused_ = false;
  v1::LiveStep gathered_;
  std::int64_t gathered_bytes_ = 0;  // in memory
  Clock::time_point oldest_;
};

}  // namespace footwall::service
