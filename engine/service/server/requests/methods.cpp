#include "engine/service/server/requests/methods.h"

#include "engine/service/server/requests/live_request.h"
#include "engine/service/server/requests/pillar_request.h"
#include "engine/service/server/requests/queued_request.h"
#include "engine/service/server/requests/status_request.h"
#include "engine/service/server/requests/task_request.h"

namespace footwall::service {
namespace {

using google::protobuf::MethodDescriptor;
using Make = std::shared_ptr<Request> (*)(const MethodDescriptor&, const std::shared_ptr<Services>&,
                                          std::shared_ptr<Reply>);

template <class Kind>
std::shared_ptr<Request> make(const MethodDescriptor& method, const std::shared_ptr<Services>& services,
                              std::shared_ptr<Reply> reply) {
  return std::make_shared<Kind>(method, services, std::move(reply));
}

template <QueuedRequest::Turn turn>
std::shared_ptr<Request> queued(const MethodDescriptor& method, const std::shared_ptr<Services>& services,
                                std::shared_ptr<Reply> reply) {
  return std::make_shared<QueuedRequest>(method, services, std::move(reply), turn);
}

struct Row {
  std::string_view name;
  Make make;
};

// Those whose requests are not simply commands of the ranks.
constexpr Row kRows[] = {
    {"Cancel", cancel_request},     {"Interpolate", make<PillarRequest>},
    {"Live", make<LiveRequest>},    {"ReadBox", queued<QueuedRequest::Turn::kBetweenSlices>},
    {"RunTask", make<TaskRequest>}, {"Shutdown", shutdown_request},
    {"Status", status_request},     {"Triangulate", make<PillarRequest>},
};

const MethodDescriptor* method_of(std::string_view path) {
  const google::protobuf::ServiceDescriptor& engine = *v1::StatusRequest::descriptor()->file()->service(0);
  const std::string prefix = "/" + engine.full_name() + "/";
  if (!path.starts_with(prefix)) return nullptr;
  return engine.FindMethodByName(std::string(path.substr(prefix.size())));
}

}  // namespace

std::shared_ptr<Request> make_request(std::string_view path, const std::shared_ptr<Services>& services,
                                      const std::shared_ptr<Reply>& reply) {
  const MethodDescriptor* method = method_of(path);
  if (method == nullptr) return nullptr;
  for (const Row& row : kRows) {
    if (row.name == method->name()) return row.make(*method, services, reply);
  }
  if (!is_command(*method->input_type())) return nullptr;
  return queued<QueuedRequest::Turn::kInOrder>(*method, services, reply);
}

}  // namespace footwall::service
