#include "engine/service/server/server.h"

#include <grpc/grpc.h>
#include <grpc/support/log.h>
#include <grpcpp/resource_quota.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <thread>

#include "engine/service/server/detail/certificate.h"
#include "engine/service/server/detail/door.h"
#include "engine/service/server/detail/listener.h"
#include "engine/service/server/private_folder.h"
#include "engine/service/server/requests/pillar_request.h"
#include "engine/service/server/requests/services.h"
#include "engine/service/words_on_the_wire.h"

namespace footwall::service {
namespace {

using Acceptor = grpc::experimental::ExternalConnectionAcceptor;

constexpr std::size_t kTransportBytes = std::size_t{512} << 20;  // of all connections, in gRPC's buffers
constexpr std::chrono::milliseconds kTick(200);
constexpr std::chrono::seconds kLeave(1);

void limit(grpc::ServerBuilder& builder, const ServerLimits& limits) {
  builder.SetMaxReceiveMessageSize(limits.message_bytes);
  builder.SetResourceQuota(grpc::ResourceQuota("engine").Resize(kTransportBytes));
  const auto set = [&](const char* name, int value) { builder.AddChannelArgument(name, value); };
  set(GRPC_ARG_MAX_CONCURRENT_STREAMS, limits.calls_of_connection);
  set(GRPC_ARG_MAX_METADATA_SIZE, limits.header_bytes);
  set(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, static_cast<int>(limits.handshake.count()));
  // A few bytes could be unpacked to any number.
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
  // Dead clients are noticed, and clients may ask as often to notice a dead engine.
  set(GRPC_ARG_KEEPALIVE_TIME_MS, 10'000);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 5'000);
  set(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  set(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // any number
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, kShortestPingMilliseconds);
}

std::shared_ptr<grpc::ServerCredentials> credentials_of(const Certificate& certificate) {
  if (certificate.key.empty()) return grpc::InsecureServerCredentials();  // a socket of this user's
  grpc::SslServerCredentialsOptions options(GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE);
  options.pem_key_cert_pairs.push_back({certificate.key, certificate.certificate});
  return grpc::SslServerCredentials(options);
}

// What the thread that takes connections is woken with at the end.
class Bell {
 public:
  Bell() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (descriptor_ < 0) throw io_error("make", "an eventfd", errno);
  }
  ~Bell() { ::close(descriptor_); }
  Bell(const Bell&) = delete;
  Bell& operator=(const Bell&) = delete;
  void ring() const { require(::eventfd_write(descriptor_, 1) == 0, "eventfd_write"); }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

struct Server::State {
  State(const ServerOptions& options, CallQueue& queue, std::function<ResidentStatus()> status,
        std::function<void()> shutdown);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void start(const ServerLimits& limits);
  void take_connections();

  std::shared_ptr<Services> services;
  Door door;
  Listener listener;
  Certificate certificate;
  Bell bell;
  std::unique_ptr<Acceptor> acceptor;
  std::unique_ptr<grpc::Server> server;
  std::thread connections;
  std::thread pillars;
};

Server::State::State(const ServerOptions& options, CallQueue& queue, std::function<ResidentStatus()> status,
                     std::function<void()> shutdown)
    : services(std::make_shared<Services>(queue, std::move(status), std::move(shutdown))),
      door(options.token, options.limits, services),
      listener(options.listen, options.limits.connections) {
  require_private_folder(options.scratch);
  services->scratch = options.scratch;
  services->version = options.version;
  if (!listener.is_unix()) certificate = engine_certificate(options.certificates);
  start(options.limits);
}

void Server::State::start(const ServerLimits& limits) {
  // One more than is ever given back: when nobody uses gRPC any longer it joins its threads, of which one may
  // sleep for ten seconds.
  grpc_init();
  // Strangers' failed handshakes would fill the log.
  if (std::getenv("GRPC_VERBOSITY") == nullptr)
    gpr_set_log_verbosity(static_cast<gpr_log_severity>(GPR_LOG_SEVERITY_ERROR + 1));
  grpc::ServerBuilder builder;
  limit(builder, limits);
  builder.RegisterCallbackGenericService(&door);
  // Connections are taken here and handed over: gRPC's own listener ends for good when the process has no
  // more files, and takes as many as there come.
  acceptor = builder.experimental().AddExternalConnectionAcceptor(
      grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD, credentials_of(certificate));
  server = builder.BuildAndStart();
  if (!server) throw Error(ErrorCode::kEngine, "the engine's server cannot be started");
  connections = std::thread([this] { take_connections(); });
  pillars = std::thread([this] { serve_pillars(*services); });
}

void Server::State::take_connections() {
  auto next_tick = std::chrono::steady_clock::now() + kTick;
  bool full = false;
  for (;;) {
    std::array<pollfd, 2> wait{{{bell.descriptor(), POLLIN, 0}, {listener.descriptor(), POLLIN, 0}}};
    // A connection that cannot be taken now stays: it is tried again at the next tick.
    const auto pause =
        std::chrono::duration_cast<std::chrono::milliseconds>(next_tick - std::chrono::steady_clock::now());
    ::poll(wait.data(), full ? 1 : 2, static_cast<int>(std::max<std::int64_t>(pause.count(), 0)) + 1);
    if (wait[0].revents != 0) return;
    full = wait[1].revents != 0;
    for (int fd = full ? listener.accept() : -1; fd >= 0; fd = listener.accept()) {
      full = false;
      Acceptor::NewConnectionParameters connection;
      connection.listener_fd = listener.descriptor();
      connection.fd = fd;
      acceptor->HandleNewConnection(&connection);
    }
    if (std::chrono::steady_clock::now() < next_tick) continue;
    next_tick = std::chrono::steady_clock::now() + kTick;
    full = false;
    door.tick();
  }
}

Server::State::~State() {
  if (connections.joinable()) {
    bell.ring();
    connections.join();
  }
  const Error why(ErrorCode::kEngine, "the engine ends", "start it again");
  services->pillars.close(why);
  door.close(why);
  if (server) {
    server->Shutdown(std::chrono::system_clock::now() + kLeave);
    server->Wait();
  }
  if (pillars.joinable()) pillars.join();
  std::error_code not_empty;  // a task that the ranks still hold removes its own part
  std::filesystem::remove(services->scratch, not_empty);
}

Server::Server(const ServerOptions& options, CallQueue& queue, std::function<ResidentStatus()> status,
               std::function<void()> shutdown)
    : state_(std::make_unique<State>(options, queue, std::move(status), std::move(shutdown))) {}

Server::~Server() = default;

std::string Server::address() const {
  return state_->listener.address();
}

std::string Server::fingerprint() const {
  return state_->certificate.fingerprint;
}

std::string Server::certificate() const {
  return state_->certificate.certificate;
}

}  // namespace footwall::service
