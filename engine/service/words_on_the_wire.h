// Names that client and server must spell alike, beside those of engine.proto.
#pragma once

namespace footwall::service {

// Metadata of every call, and of a call that failed: a v1::Failure in bytes.
inline constexpr const char* kTokenMetadata = "footwall-token";
inline constexpr const char* kFailureMetadata = "footwall-error-bin";
// Metadata of a call that only the engine with this process is to take: one that was started since, at the
// same address, does not hold what the client thinks.
inline constexpr const char* kProcessMetadata = "footwall-process";
// The subject (CN) and DNS name of an engine's certificate, whatever host it runs on: clients pin the
// certificate itself.
inline constexpr const char* kCertificateName = "footwall-engine";
// The environment variable through which an engine gets its token, and a client may.
inline constexpr const char* kTokenVariable = "FOOTWALL_ENGINE_TOKEN";
// Clients ask whether the other side is still there so often while a call runs, and wait so long for the
// answer, which the engine's threads give while its ranks compute. Together they are below two seconds; the
// patience is longer than a pause that means nothing.
inline constexpr int kPingMilliseconds = 700;
inline constexpr int kPingPatienceMilliseconds = 1100;
// What servers must bear (GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS).
inline constexpr int kShortestPingMilliseconds = 500;

}  // namespace footwall::service
