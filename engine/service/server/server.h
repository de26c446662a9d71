// The engine's RPC server: turns clients' calls into Calls of the queue. No MPI in here.
//
// Who may call: whoever has the token (metadata "footwall-token", compared in constant time). A call without
// it gets UNAUTHENTICATED, whatever its method, known or not.
#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "engine/service/queue/call_queue.h"
#include "engine/service/resident_status.h"

namespace footwall::service {

// What strangers and slow clients may use up.
struct ServerLimits {
  std::size_t connections = 256;
  std::size_t calls = 256;
  int calls_of_connection = 64;
  int message_bytes = 64 << 20;
  int header_bytes = 8 << 10;
  std::chrono::milliseconds handshake{10'000};
  std::chrono::milliseconds reading{5000};   // a client that takes nothing of an answer
  std::chrono::milliseconds asking{30'000};  // one that opens a call and says nothing
  // Calls without the token that are answered at once; of more, the answers wait.
  double failures_burst = 50;
  double failures_per_second = 50;
};

struct ServerOptions {
  // "unix:PATH": a socket that is made with mode 0600 in a folder that is this user's alone. "tcp:HOST:PORT":
  // TLS, with the certificate in `certificates`, made on first use; port 0: any.
  std::string listen;
  std::string token;  // at least 32 characters
  std::filesystem::path
      certificates;               // a private folder for key and certificate, which stay; unused with unix:
  std::filesystem::path scratch;  // a private folder for the files of RunTask
  std::string version;            // for Status
  ServerLimits limits;
};

class Server {
 public:
  // Begins to serve. queue, status: used until the end; `shutdown` is called, once, by a client's Shutdown,
  // on a thread of the server, which it must not end. Throws Error kUsage (listen), kIo, kEngine (the address
  // is taken ...).
  Server(const ServerOptions& options, CallQueue& queue, std::function<ResidentStatus()> status,
         std::function<void()> shutdown);
  // Ends the calls under way, at the latest after a second.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // How clients reach it: "unix:PATH" or "tcp:HOST:PORT" with the port that was taken.
  std::string address() const;
  // SHA-256 of the certificate, as "AB:CD:...", and the certificate itself as PEM; empty with unix:.
  std::string fingerprint() const;
  std::string certificate() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::service
