// Requests that are answered at once, whatever the ranks do: Status, Cancel, Shutdown.
#pragma once
#include <functional>

#include "engine/service/server/requests/rank_call.h"

namespace footwall::service {

class ImmediateRequest final : public Request {
 public:
  // answer: fills the method's reply from its request.
  using Answer =
      std::function<void(const google::protobuf::Message& request, google::protobuf::Message& reply)>;
  // after: when the reply is on its way.
  ImmediateRequest(const google::protobuf::MethodDescriptor& method, std::shared_ptr<Reply> reply,
                   Answer answer, std::function<void()> after = {});

  void received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) override;
  void no_more() override;
  void left() noexcept override {}

 private:
  const google::protobuf::MethodDescriptor& method_;
  std::shared_ptr<Reply> reply_;
  Answer answer_;
  std::function<void()> after_;
};

std::shared_ptr<Request> status_request(const google::protobuf::MethodDescriptor& method,
                                        const std::shared_ptr<Services>& services,
                                        std::shared_ptr<Reply> reply);
std::shared_ptr<Request> cancel_request(const google::protobuf::MethodDescriptor& method,
                                        const std::shared_ptr<Services>& services,
                                        std::shared_ptr<Reply> reply);
std::shared_ptr<Request> shutdown_request(const google::protobuf::MethodDescriptor& method,
                                          const std::shared_ptr<Services>& services,
                                          std::shared_ptr<Reply> reply);

}  // namespace footwall::service
