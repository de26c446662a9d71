// A flood of what no client should send: bytes that are no messages, messages beyond the limit, connections
// that say nothing or nonsense, calls that are left at once, wrong tokens. Afterwards the server answers as
// before, and has not grown. FOOTWALL_TEST_FACTOR=500 makes a million of them.
#include <grpcpp/generic/generic_stub.h>
#include <malloc.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <fstream>
#include <random>

#include "engine_at_work.h"
#include "rounds.h"

namespace footwall::service {
namespace {

constexpr int kThreads = 4;

std::int64_t resident_mib() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  statm >> total >> resident;
  return resident * ::sysconf(_SC_PAGESIZE) >> 20;
}

// What is in use of the heap, without what the allocator keeps for later.
std::int64_t heap_kib() {
  const auto facts = ::mallinfo2();
  return static_cast<std::int64_t>(facts.uordblks + facts.hblkhd) >> 10;
}

using Random = std::mt19937_64;

std::string noise(Random& random, std::size_t most) {
  std::string bytes(random() % (most + 1), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % 256);
  // Often something that begins like a message: a field with a length.
  if (!bytes.empty() && random() % 2 == 0) bytes[0] = static_cast<char>((1 + random() % 5) << 3 | 2);
  return bytes;
}

// One that connects, says something that is no RPC, and goes or stays.
class Connection {
 public:
  Connection(const std::string& path, Random& random)
      : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un where = {};
    where.sun_family = AF_UNIX;
    path.copy(where.sun_path, sizeof(where.sun_path) - 1);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&where), sizeof(where)) != 0) return;
    std::string said = random() % 2 == 0 ? "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" : "";
    if (random() % 4 != 0) said += noise(random, 2000);
    [[maybe_unused]] const ssize_t sent = ::send(socket_, said.data(), said.size(), MSG_NOSIGNAL);
  }
  ~Connection() { ::close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

 private:
  int socket_;
};

class Flood {
 public:
  Flood(const EngineAtWork& engine, std::uint64_t seed)
      : path_(engine.server->address().substr(5)), stub_(engine.channel()), random_(seed) {}

  // One thing that no client should send.
  void throw_one() {
    const std::uint64_t kind = random_() % 100;
    if (kind < 4) {
      half_open_.push_back(std::make_unique<Connection>(path_, random_));
      if (half_open_.size() > 8) half_open_.pop_front();
    } else if (kind < 5) {
      call(std::string(200'000, 'x'), kToken, false);  // beyond the limit
    } else if (kind < 7) {
      call(noise(random_, 100), kToken, true);
    } else if (kind < 8) {
      call(noise(random_, 100), "wrong", true);
    } else {
      call(noise(random_, 300), kToken, false);
    }
  }

 private:
  void call(const std::string& bytes, const std::string& token, bool leaves) {
    static constexpr const char* kMethods[] = {"Status",     "Cancel",    "OpenVolume",  "CloseVolume",
                                               "EditModel",  "ReadModel", "Extract",     "Live",
                                               "FaceVoxels", "ReadBox",   "Interpolate", "Triangulate",
                                               "Isosurface", "Render",    "RunTask",     "Nothing"};
    Context context(token);
    grpc::CompletionQueue queue;
    const grpc::Slice slice(bytes);
    const grpc::ByteBuffer request(&slice, 1);
    grpc::ByteBuffer reply;
    grpc::Status status;
    const auto call = stub_.PrepareUnaryCall(
        &context, fmt::format("/footwall.v1.Engine/{}", kMethods[random_() % std::size(kMethods)]), request,
        &queue);
    call->StartCall();
    call->Finish(&reply, &status, nullptr);
    if (leaves) context.TryCancel();
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    EXPECT_NE(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED) << "a call hangs";
    EXPECT_NE(status.error_code(), grpc::StatusCode::INTERNAL) << status.error_message();
    queue.Shutdown();
    while (queue.Next(&tag, &ok)) {
    }
  }

  std::string path_;
  grpc::GenericStub stub_;
  Random random_;
  std::deque<std::unique_ptr<Connection>> half_open_;
};

TEST(Flood, DoesNotCrashHangOrGrowTheServer) {
  ServerLimits limits;
  limits.message_bytes = 100'000;
  EngineAtWork engine([](const v1::Command&, Call&) { throw Error(ErrorCode::kNotFound, "no such volume"); },
                      limits);
  const int each = rounds(2000) / kThreads;
  const std::int64_t heap_before = heap_kib();
  std::atomic<std::int64_t> settled_mib{0};
  std::vector<std::thread> threads;
  for (int thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      Flood flood(engine, static_cast<std::uint64_t>(thread));
      for (int n = 0; n < each; ++n) {
        flood.throw_one();
        if (thread == 0 && n == each / 10) settled_mib = resident_mib();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  Context context;
  v1::StatusReply status;
  EXPECT_TRUE(engine.stub->Status(&context, {}, &status).ok());
  EXPECT_EQ(status.jobs_size(), 0);
  EXPECT_TRUE(std::filesystem::is_empty(engine.folder / "scratch"));
  const std::int64_t growth = resident_mib() - settled_mib;
  // What is in use tells a leak; the process may have more, which the allocator keeps for the next flood.
  const std::int64_t heap_growth = heap_kib() - heap_before;
  fmt::print(
      "{} things thrown; memory {} MiB after a tenth, {} MiB more at the end; {} KiB more of the heap in "
      "use\n",
      kThreads * each, settled_mib.load(), growth, heap_growth);
  EXPECT_LT(heap_growth, 4096);
  EXPECT_LT(growth, 64);
}

}  // namespace
}  // namespace footwall::service
