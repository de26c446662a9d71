// A request that is a command of the ranks as it stands.
#pragma once
#include "engine/service/ranks.pb.h"
#include "engine/service/server/requests/rank_call.h"

namespace footwall::service {

class QueuedRequest final : public RankCall {
 public:
  enum class Turn : std::uint8_t {
    kInOrder,       // after those that came before
    kBetweenSlices  // reads that no other rank takes part in
  };
  QueuedRequest(const google::protobuf::MethodDescriptor& method, std::shared_ptr<Services> services,
                std::shared_ptr<Reply> reply, Turn turn);

  void received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) override;
  void no_more() override;
  v1::Command take_command() override;

 private:
  Turn turn_;
  v1::Command command_;
};

// Whether requests of this type are commands.
bool is_command(const google::protobuf::Descriptor& type);

}  // namespace footwall::service
