// The engine's methods by name.
#pragma once
#include <memory>
#include <string_view>

#include "engine/service/server/requests/reply.h"
#include "engine/service/server/requests/request.h"
#include "engine/service/server/requests/services.h"

namespace footwall::service {

// path: as HTTP has it, "/footwall.v1.Engine/Status". Null where there is no such method.
std::shared_ptr<Request> make_request(std::string_view path, const std::shared_ptr<Services>& services,
                                      const std::shared_ptr<Reply>& reply);

}  // namespace footwall::service
