// A client's call that is carried out in its turn: what all of them share.
#pragma once
#include <google/protobuf/descriptor.h>

#include <atomic>
#include <memory>

#include "engine/service/queue/call.h"
#include "engine/service/server/requests/reply.h"
#include "engine/service/server/requests/request.h"
#include "engine/service/server/requests/services.h"

namespace footwall::service {

// An empty message of the type.
std::unique_ptr<google::protobuf::Message> new_message(const google::protobuf::Descriptor& type);

class RankCall : public Call, public Request, public std::enable_shared_from_this<RankCall> {
 public:
  RankCall(const google::protobuf::MethodDescriptor& method, std::shared_ptr<Services> services,
           std::shared_ptr<Reply> reply);
  ~RankCall() override;

  void send(const google::protobuf::Message& message) override;
  void finish(const std::optional<Error>& failure) noexcept override;
  void left() noexcept override;

 protected:
  void progressed(const State& state) override;
  // Unpacks a message whose memory waits until the call is gone or forget() is called. How much that is.
  // Throws as Parcel, and as remember().
  std::int64_t unpack(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size,
                      google::protobuf::Message& into);
  // Counts bytes that wait until the call is gone or forget() is called; throws Error kMemory where all calls
  // together have too many.
  void remember(std::int64_t bytes);
  void forget() noexcept;
  // Some of what was remembered.
  void give_back(std::int64_t bytes) noexcept;
  // The queue that the call waits in.
  virtual CallQueue& home() { return services_->queue; }

  const google::protobuf::MethodDescriptor& method_;
  std::shared_ptr<Services> services_;
  std::shared_ptr<Reply> reply_;

 private:
  std::atomic<std::int64_t> sent_{0};
  std::atomic<std::int64_t> remembered_{0};
};

}  // namespace footwall::service
