// EngineClient::live() over gRPC.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "engine/service/client/engine_client.h"
#include "engine/service/engine.grpc.pb.h"

namespace footwall::service {

// first: volume and options. still_there: whether the engine answers another call. The stub must outlive the
// stream.
std::unique_ptr<EngineClient::LiveStream> open_live_stream(const std::shared_ptr<grpc::Channel>& channel,
                                                           v1::Engine::Stub& stub, const std::string& token,
                                                           v1::LiveRequest first,
                                                           std::function<void(const v1::LiveReply&)> answer,
                                                           std::function<bool()> still_there);

}  // namespace footwall::service
