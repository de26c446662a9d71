// What strangers, slow clients and broken ones can do to a server: nothing.
#include <grpcpp/generic/generic_stub.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "engine/service/server/detail/certificate.h"
#include "engine/service/server/detail/listener.h"
#include "engine/service/server/detail/token.h"
#include "engine_at_work.h"
#include "storage/base/partial_file.h"

namespace footwall::service {
namespace {

using Milliseconds = std::chrono::milliseconds;

// A unary call of any path with any bytes.
grpc::Status ask(const std::shared_ptr<grpc::Channel>& channel, const std::string& path, Context& context,
                 const std::string& bytes = {}) {
  grpc::GenericStub stub(channel);
  grpc::CompletionQueue queue;
  const grpc::Slice slice(bytes);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer reply;
  grpc::Status status;
  const auto call = stub.PrepareUnaryCall(&context, path, request, &queue);
  call->StartCall();
  call->Finish(&reply, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  queue.Shutdown();
  while (queue.Next(&tag, &ok)) {
  }
  return status;
}

std::string all_that_is_told(const grpc::Status& status, const Context& context) {
  std::string told = fmt::format("{} {} {}", static_cast<int>(status.error_code()), status.error_message(),
                                 status.error_details());
  for (const auto& [name, value] : context.GetServerInitialMetadata())
    told +=
        fmt::format(" {}={}", std::string(name.data(), name.size()), std::string(value.data(), value.size()));
  for (const auto& [name, value] : context.GetServerTrailingMetadata())
    told +=
        fmt::format(" {}={}", std::string(name.data(), name.size()), std::string(value.data(), value.size()));
  return told;
}

TEST(ServerSafety, WithoutTheTokenEveryPathHasOneAnswer) {
  EngineAtWork engine;
  const auto channel = engine.channel();
  std::set<std::string> answers;
  for (const std::string& token : {std::string(), std::string("wrong"), kToken.substr(1), kToken + "0",
                                   std::string(kToken.size(), 'x')}) {
    for (const char* path :
         {"/footwall.v1.Engine/Status", "/footwall.v1.Engine/Shutdown", "/footwall.v1.Engine/Nothing", "/",
          "/grpc.health.v1.Health/Check", "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo"}) {
      Context context(token);
      const grpc::Status status = ask(channel, path, context);
      EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAUTHENTICATED) << path << " " << token;
      answers.insert(all_that_is_told(status, context));
    }
  }
  EXPECT_EQ(answers.size(), 1U) << *answers.rbegin();
  Context twice;
  twice.AddMetadata("footwall-token", kToken);
  EXPECT_EQ(ask(channel, "/footwall.v1.Engine/Status", twice).error_code(),
            grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(engine.shutdowns, 0);
}

TEST(ServerSafety, ManyWrongTokensAreAnsweredSlowly) {
  ServerLimits limits;
  limits.failures_burst = 3;
  limits.failures_per_second = 10;
  EngineAtWork engine({}, limits);
  const auto channel = engine.channel();
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < 8; ++n) {
    Context context("wrong");
    EXPECT_EQ(ask(channel, "/footwall.v1.Engine/Status", context).error_code(),
              grpc::StatusCode::UNAUTHENTICATED);
  }
  // Five beyond the burst, a tenth of a second each: no machine is too slow for at least that.
  EXPECT_GE(std::chrono::steady_clock::now() - begin, Milliseconds(490));
  Context context;
  EXPECT_TRUE(ask(channel, "/footwall.v1.Engine/Status", context).ok());
}

TEST(ServerSafety, MethodsThatAreNotThereAndBytesThatAreNoMessage) {
  EngineAtWork engine([](const v1::Command&, Call& call) { call.send(v1::CloseVolumeReply()); });
  const auto channel = engine.channel();
  for (const char* path : {"/footwall.v1.Engine/Nothing", "/footwall.v1.Engine", "/footwall.v2.Engine/Status",
                           "/footwall.v1.Engine/Status/", "/"}) {
    Context context;
    EXPECT_EQ(ask(channel, path, context).error_code(), grpc::StatusCode::UNIMPLEMENTED) << path;
  }
  for (const char* name : {"Status", "CloseVolume", "Live", "RunTask", "Triangulate"}) {
    Context context;
    const grpc::Status status =
        ask(channel, fmt::format("/footwall.v1.Engine/{}", name), context, std::string("\xff\xff\xff"));
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << name;
    EXPECT_EQ(context.failure().code(), "invalid") << name;
  }
  EXPECT_EQ(engine.ranks.served(), 0);
}

TEST(ServerSafety, AMessageBeyondTheLimitIsRefused) {
  ServerLimits limits;
  limits.message_bytes = 1 << 20;
  EngineAtWork engine([](const v1::Command&, Call& call) { call.send(v1::EditModelReply()); }, limits);
  v1::EditBatch batch;
  batch.add_edits()->set_mesh(std::string(2 << 20, 'x'));
  Context context;
  v1::EditModelReply reply;
  EXPECT_EQ(engine.stub->EditModel(&context, batch, &reply).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(engine.ranks.served(), 0);
  batch.mutable_edits(0)->set_mesh("small");
  Context again;
  EXPECT_TRUE(engine.stub->EditModel(&again, batch, &reply).ok());
}

TEST(ServerSafety, CompressedMessagesAreRefused) {
  EngineAtWork engine([](const v1::Command&, Call& call) { call.send(v1::EditModelReply()); });
  v1::EditBatch batch;
  batch.add_edits()->set_mesh(std::string(1 << 20, 'x'));
  Context context;
  context.set_compression_algorithm(GRPC_COMPRESS_GZIP);
  v1::EditModelReply reply;
  EXPECT_EQ(engine.stub->EditModel(&context, batch, &reply).error_code(), grpc::StatusCode::UNIMPLEMENTED);
  EXPECT_EQ(engine.ranks.served(), 0);
}

TEST(ServerSafety, HeadersBeyondTheLimitAreRefused) {
  EngineAtWork engine;
  Context context;
  context.AddMetadata("more", std::string(100'000, 'x'));
  v1::StatusReply reply;
  EXPECT_EQ(engine.stub->Status(&context, {}, &reply).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST(ServerSafety, AClientThatTakesNothingIsGivenUp) {
  ServerLimits limits;
  limits.reading = Milliseconds(300);
  std::atomic<int> sent{0};
  EngineAtWork engine(
      [&](const v1::Command&, Call& call) {
        v1::ReadBoxReply reply;
        reply.set_values(std::string(1 << 20, 'x'));
        for (int n = 0; n < 1000; ++n, ++sent) call.send(reply);
      },
      limits);
  Context slow;
  const auto reader = engine.stub->ReadBox(&slow, {});
  ASSERT_TRUE(eventually([&] { return engine.ranks.served() == 1; }));
  EXPECT_LT(sent, 100);  // what fits into the outbox and on the way
  v1::ReadBoxReply reply;
  while (reader->Read(&reply)) {
  }
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST(ServerSafety, AnAnswerThatNobodyTakesIsDropped) {
  ServerLimits limits;
  limits.reading = Milliseconds(300);
  limits.calls = 1;
  EngineAtWork engine(
      [&](const v1::Command&, Call& call) {
        v1::ReadBoxReply reply;
        reply.set_values(std::string(7 << 20, 'x'));
        call.send(reply);
      },
      limits);
  Context slow;
  const auto reader = engine.stub->ReadBox(&slow, {});
  ASSERT_TRUE(eventually([&] { return engine.ranks.served() == 1; }));
  // The ranks are done with it, and the one place there is becomes free though the client takes nothing.
  EXPECT_TRUE(eventually([&] {
    Context context;
    v1::StatusReply status;
    return engine.stub->Status(&context, {}, &status).ok();
  }));
  slow.TryCancel();
  v1::ReadBoxReply reply;
  while (reader->Read(&reply)) {
  }
  EXPECT_FALSE(reader->Finish().ok());
}

TEST(ServerSafety, ACallThatAsksNothingIsEnded) {
  ServerLimits limits;
  limits.asking = Milliseconds(200);
  EngineAtWork engine({}, limits);
  Context context;
  const auto live = engine.stub->Live(&context);
  v1::LiveReply reply;
  EXPECT_FALSE(live->Read(&reply));
  EXPECT_EQ(live->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST(ServerSafety, NoMoreCallsThanThereMayBe) {
  Gate gate;
  ServerLimits limits;
  limits.calls = 2;
  EngineAtWork engine([&](const v1::Command&, Call& call) { gate.wait(call); }, limits);
  Context first_context;
  Context second_context;
  const auto first = engine.stub->Extract(&first_context, {});
  const auto second = engine.stub->Extract(&second_context, {});
  ASSERT_TRUE(eventually([&] { return engine.queue.entries().size() == 2; }));
  Context third;
  v1::StatusReply reply;
  EXPECT_EQ(engine.stub->Status(&third, {}, &reply).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  gate.open();
  EXPECT_TRUE(first->Finish().ok());
  EXPECT_TRUE(second->Finish().ok());
  EXPECT_TRUE(eventually([&] {
    Context context;
    return engine.stub->Status(&context, {}, &reply).ok();
  }));
}

int connected(const std::string& address) {
  const bool is_unix = address.starts_with("unix:");
  const int descriptor = ::socket(is_unix ? AF_UNIX : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int done = 0;
  if (is_unix) {
    sockaddr_un where = {};
    where.sun_family = AF_UNIX;
    address.substr(5).copy(where.sun_path, sizeof(where.sun_path) - 1);
    done = ::connect(descriptor, reinterpret_cast<const sockaddr*>(&where), sizeof(where));
  } else {
    sockaddr_in where = {};
    where.sin_family = AF_INET;
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    where.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
    done = ::connect(descriptor, reinterpret_cast<const sockaddr*>(&where), sizeof(where));
  }
  EXPECT_EQ(done, 0);
  return descriptor;
}

// Waits for the server's end of a connection.
bool is_closed(int descriptor) {
  const timeval minute{60, 0};
  ::setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &minute, sizeof(minute));
  std::array<char, 4096> bytes{};
  for (;;) {
    const ssize_t n = ::recv(descriptor, bytes.data(), bytes.size(), 0);
    if (n > 0 || (n < 0 && errno == EINTR)) continue;
    return n == 0 || errno == ECONNRESET;
  }
}

TEST(ServerSafety, HalfOpenConnectionsAreFewAndEndInTime) {
  ServerLimits limits;
  limits.connections = 4;
  limits.handshake = Milliseconds(500);
  for (const char* listen : {"", "tcp:127.0.0.1:0"}) {
    EngineAtWork engine({}, limits, 256, listen);
    std::vector<int> half_open;
    for (int n = 0; n < 10; ++n) half_open.push_back(connected(engine.server->address()));
    for (const int one : half_open) EXPECT_TRUE(is_closed(one)) << listen;
    Context context;
    v1::StatusReply reply;
    context.set_wait_for_ready(true);
    EXPECT_TRUE(engine.stub->Status(&context, {}, &reply).ok()) << listen;
    for (const int one : half_open) ::close(one);
  }
}

TEST(ServerSafety, TcpHasTlsWithTheEnginesCertificate) {
  EngineAtWork engine([](const v1::Command&, Call& call) { call.send(v1::CloseVolumeReply()); }, {}, 256,
                      "tcp:127.0.0.1:0");
  const std::string address = engine.server->address();
  EXPECT_TRUE(address.starts_with("tcp:127.0.0.1:")) << address;
  EXPECT_EQ(engine.server->fingerprint().size(), 95U);
  EXPECT_EQ(engine.server->fingerprint(), fingerprint_of(engine.server->certificate()));
  Context context;
  v1::CloseVolumeReply reply;
  EXPECT_TRUE(engine.stub->CloseVolume(&context, {}, &reply).ok());
  Context stranger("wrong");
  EXPECT_EQ(engine.stub->CloseVolume(&stranger, {}, &reply).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  // Without TLS nothing is told.
  const auto plain = grpc::CreateChannel(address.substr(4), grpc::InsecureChannelCredentials());
  Context open;
  EXPECT_EQ(v1::Engine::NewStub(plain)->CloseVolume(&open, {}, &reply).error_code(),
            grpc::StatusCode::UNAVAILABLE);
  // Nor to a client that was given another engine's certificate.
  const ScratchFolder other;
  grpc::SslCredentialsOptions options;
  options.pem_root_certs = engine_certificate(other / "c").certificate;
  grpc::ChannelArguments arguments;
  arguments.SetSslTargetNameOverride(kCertificateName);
  const auto wrong = grpc::CreateCustomChannel(address.substr(4), grpc::SslCredentials(options), arguments);
  Context deceived;
  EXPECT_EQ(v1::Engine::NewStub(wrong)->CloseVolume(&deceived, {}, &reply).error_code(),
            grpc::StatusCode::UNAVAILABLE);
}

ErrorCode code_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::kInternal;
}

TEST(ServerSafety, AddressesThatCannotBeServed) {
  const ScratchFolder folder;
  const auto listen = [](const std::string& where) { return code_of([&] { Listener(where, 1); }); };
  EXPECT_EQ(listen("nowhere"), ErrorCode::kUsage);
  EXPECT_EQ(listen("tcp:127.0.0.1"), ErrorCode::kUsage);
  EXPECT_EQ(listen("tcp:127.0.0.1:70000"), ErrorCode::kUsage);
  EXPECT_EQ(listen("tcp::80"), ErrorCode::kUsage);
  EXPECT_EQ(listen("unix:" + (folder / std::string(200, 'x')).string()), ErrorCode::kUsage);
  folder.file("file", "not a socket");
  EXPECT_EQ(listen("unix:" + (folder / "file").string()), ErrorCode::kUsage);
  std::filesystem::create_directory(folder / "open");
  std::filesystem::permissions(folder / "open", std::filesystem::perms(0755));
  EXPECT_EQ(listen("unix:" + (folder / "open" / "socket").string()), ErrorCode::kUsage);
  const std::string address = "unix:" + (folder / "socket").string();
  {
    const Listener first(address, 1);
    EXPECT_EQ(listen(address), ErrorCode::kEngine);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "socket"));
  const Listener tcp("tcp:127.0.0.1:0", 1);
  EXPECT_EQ(listen(tcp.address()), ErrorCode::kEngine);
}

TEST(ServerSafety, ASocketThatADeadEngineLeftIsTakenOver) {
  const ScratchFolder folder;
  const std::string path = folder / "socket";
  sockaddr_un where = {};
  where.sun_family = AF_UNIX;
  path.copy(where.sun_path, sizeof(where.sun_path) - 1);
  const int dead = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(dead, reinterpret_cast<const sockaddr*>(&where), sizeof(where)), 0);
  ::close(dead);
  const Listener listener("unix:" + path, 1);
  EXPECT_EQ(listener.address(), "unix:" + path);
}

TEST(ServerSafety, TheCertificateStaysAndIsPrivate) {
  const ScratchFolder folder;
  const Certificate made = engine_certificate(folder / "c");
  const Certificate again = engine_certificate(folder / "c");
  EXPECT_EQ(made.fingerprint, again.fingerprint);
  EXPECT_EQ(made.key, again.key);
  using std::filesystem::perms;
  const std::filesystem::path file = folder / "c" / "engine.pem";
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms(0600));
  EXPECT_EQ(std::filesystem::status(folder / "c").permissions(), perms(0700));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "c"), {}), 1);
  EXPECT_EQ(made.key.find("CERTIFICATE"), std::string::npos);
  EXPECT_EQ(made.certificate.find("KEY"), std::string::npos);
  EXPECT_NE(engine_certificate(folder / "d").fingerprint, made.fingerprint);

  // Near its end there is a new one, which stays.
  constexpr std::time_t kDay = 24 * 3600;
  const std::time_t now = std::time(nullptr);
  EXPECT_EQ(engine_certificate(folder / "c", now + 3600 * kDay).fingerprint, made.fingerprint);
  const std::string renewed = engine_certificate(folder / "c", now + 3630 * kDay).fingerprint;
  EXPECT_NE(renewed, made.fingerprint);
  EXPECT_EQ(engine_certificate(folder / "c").fingerprint, renewed);
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms(0600));

  // A key that others may know or have made is not used, nor a folder that is not this user's alone.
  std::filesystem::permissions(file, perms(0640));
  EXPECT_EQ(code_of([&] { engine_certificate(folder / "c"); }), ErrorCode::kUsage);
  std::filesystem::permissions(file, perms(0600));
  std::filesystem::permissions(folder / "c", perms(0750));
  EXPECT_EQ(code_of([&] { engine_certificate(folder / "c"); }), ErrorCode::kUsage);
  std::filesystem::permissions(folder / "c", perms(0700));
  std::filesystem::rename(file, folder / "elsewhere");
  std::filesystem::create_symlink(folder / "elsewhere", file);
  EXPECT_EQ(code_of([&] { engine_certificate(folder / "c"); }), ErrorCode::kUsage);
  if (::geteuid() == 0) {
    std::filesystem::remove(file);
    ASSERT_EQ(::chown((folder / "c").c_str(), 12345, 12345), 0);
    EXPECT_EQ(code_of([&] { engine_certificate(folder / "c"); }), ErrorCode::kUsage);
  }

  // A key of one with the certificate of another.
  const std::filesystem::path mixed = folder / "d" / "engine.pem";
  std::filesystem::permissions(folder / "d", perms(0700));
  write_whole_file(mixed, made.key + engine_certificate(folder / "e").certificate);
  std::filesystem::permissions(mixed, perms(0600));
  EXPECT_EQ(code_of([&] { engine_certificate(folder / "d"); }), ErrorCode::kCorrupt);
  EXPECT_EQ(code_of([] { fingerprint_of("no certificate"); }), ErrorCode::kFormat);
}

TEST(ServerSafety, EnginesThatStartAtOnceTakeOneCertificate) {
  const ScratchFolder folder;
  std::array<std::string, 8> prints;
  std::vector<std::thread> engines;
  for (std::string& print : prints)
    engines.emplace_back([&] { print = engine_certificate(folder / "a" / "b" / "c").fingerprint; });
  for (std::thread& engine : engines) engine.join();
  for (const std::string& print : prints) EXPECT_EQ(print, prints[0]);
}

TEST(ServerSafety, Tokens) {
  const Token token(kToken);
  EXPECT_TRUE(token.is(kToken));
  EXPECT_FALSE(token.is(""));
  EXPECT_FALSE(token.is(kToken + "0"));
  EXPECT_EQ(code_of([] { Token("short"); }), ErrorCode::kUsage);
  FailureRate rate(2, 1);
  const auto now = std::chrono::steady_clock::now();
  EXPECT_TRUE(rate.allows(now));
  EXPECT_TRUE(rate.allows(now));
  EXPECT_FALSE(rate.allows(now));
  EXPECT_TRUE(rate.allows(now + Milliseconds(1100)));
}

}  // namespace
}  // namespace footwall::service
