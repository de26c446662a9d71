#include "engine/service/server/detail/door.h"

#include <fmt/format.h>
#include <unistd.h>

#include "engine/service/server/requests/failure.h"
#include "engine/service/server/requests/methods.h"
#include "engine/service/words_on_the_wire.h"

namespace footwall::service {
namespace {

std::optional<Error> meant_for_another(const grpc::CallbackServerContext& context) {
  const auto found = context.client_metadata().find(kProcessMetadata);
  if (found == context.client_metadata().end() ||
      std::string_view(found->second.data(), found->second.size()) == std::to_string(::getpid())) {
    return std::nullopt;
  }
  return Error(ErrorCode::kEngine, "the engine was started again since",
               "ask what it holds now, and tell it what it should");
}

}  // namespace

Door::Door(const std::string& token, const ServerLimits& limits, std::shared_ptr<Services> services)
    : token_(token),
      limits_(limits),
      services_(std::move(services)),
      refusals_(limits.failures_burst, limits.failures_per_second) {}

bool Door::has_token(const grpc::CallbackServerContext& context) const {
  const auto [first, last] = context.client_metadata().equal_range(kTokenMetadata);
  // Hashing is done for none, too: its time tells nothing.
  const bool is_one = first != last && std::next(first) == last;
  const std::string_view offered =
      is_one ? std::string_view(first->second.data(), first->second.size()) : std::string_view();
  return token_.is(offered);
}

std::optional<Error> Door::take_in(const std::shared_ptr<Stream>& stream) {
  const std::scoped_lock lock(mutex_);
  const bool is_full = streams_.size() >= limits_.calls;
  streams_.emplace(stream.get(), stream);
  if (closed_) return closed_;
  if (!is_full) return std::nullopt;
  return Error(ErrorCode::kMemory, fmt::format("{} calls are under way already", limits_.calls),
               "end some of them first");
}

grpc::ServerGenericBidiReactor* Door::CreateReactor(grpc::GenericCallbackServerContext* context) {
  if (!has_token(*context)) return refusals_.refuse();
  const std::shared_ptr<Stream> stream =
      Stream::open(*context, {limits_.reading, limits_.asking}, [this](const Stream& done) {
        const std::scoped_lock lock(mutex_);
        streams_.erase(&done);
      });
  std::optional<Error> refusal = take_in(stream);
  if (!refusal) refusal = meant_for_another(*context);
  std::shared_ptr<Request> request;
  if (!refusal) {
    request = make_request(context->method(), services_, stream);
    if (!request) {
      refusal = Error(ErrorCode::kUnsupported, fmt::format("the engine has no method {}", context->method()),
                      "client and engine may be of different versions");
    }
  }
  if (refusal) {
    stream->end(refusal);
  } else {
    stream->serve(std::move(request));
  }
  return stream.get();
}

std::vector<std::shared_ptr<Stream>> Door::streams() {
  const std::scoped_lock lock(mutex_);
  std::vector<std::shared_ptr<Stream>> all;
  for (const auto& [place, stream] : streams_) {
    if (auto one = stream.lock()) all.push_back(std::move(one));
  }
  return all;
}

void Door::tick() {
  refusals_.tick();
  const auto now = Stream::Clock::now();
  for (const auto& stream : streams()) stream->tick(now);
}

void Door::close(const Error& why) {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = why;
  }
  refusals_.close();
  for (const auto& stream : streams()) stream->drop(why);
}

}  // namespace footwall::service
