// Where calls come in: the token first, then the method.
#pragma once
#include <grpcpp/generic/async_generic_service.h>

#include <memory>
#include <mutex>
#include <unordered_map>

#include "engine/service/server/detail/refusal.h"
#include "engine/service/server/detail/stream.h"
#include "engine/service/server/detail/token.h"
#include "engine/service/server/requests/services.h"
#include "engine/service/server/server.h"

namespace footwall::service {

class Door final : public grpc::CallbackGenericService {
 public:
  Door(const std::string& token, const ServerLimits& limits, std::shared_ptr<Services> services);

  // All calls, of known methods or not, come through here.
  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override;
  // What takes time: answers that wait, clients that are too slow. Called some times a second.
  void tick();
  // Ends all calls and takes no more.
  void close(const Error& why);

 private:
  bool has_token(const grpc::CallbackServerContext& context) const;
  // Why a call may not be served now.
  std::optional<Error> take_in(const std::shared_ptr<Stream>& stream);
  std::vector<std::shared_ptr<Stream>> streams();

  const Token token_;
  const ServerLimits limits_;
  const std::shared_ptr<Services> services_;
  Refusals refusals_;
  std::mutex mutex_;
  std::unordered_map<const Stream*, std::weak_ptr<Stream>> streams_;
  std::optional<Error> closed_;
};

}  // namespace footwall::service
