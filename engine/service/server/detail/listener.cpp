#include "engine/service/server/detail/listener.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>

#include "engine/service/server/private_folder.h"
#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::service {
namespace {

constexpr int kBacklog = 128;

std::optional<ino_t> inode_of(int descriptor) {
  struct stat facts = {};
  if (::fstat(descriptor, &facts) != 0 || !S_ISSOCK(facts.st_mode)) return std::nullopt;
  return facts.st_ino;
}

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} cannot be a socket: it has {} characters, {} it may have", path, path.size(),
                            sizeof(address.sun_path) - 1),
                "name a shorter path");
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

// Removes a socket that nobody listens at.
void remove_dead(const std::string& path, const sockaddr_un& address) {
  struct stat facts = {};
  if (::lstat(path.c_str(), &facts) != 0) return;
  if (!S_ISSOCK(facts.st_mode))
    throw Error(ErrorCode::kUsage, fmt::format("{} is there already and is no socket", path));
  const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (probe < 0) throw io_error("make a socket for", path, errno);
  const bool answered = ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  const int trouble = errno;
  ::close(probe);
  if (answered || trouble != ECONNREFUSED) {
    throw Error(ErrorCode::kEngine, fmt::format("somebody listens at {} already", path),
                "use that engine, or name another address");
  }
  ::unlink(path.c_str());
}

struct Tcp {
  std::string host;
  std::string port;
};

// "HOST:PORT", "[::1]:PORT".
Tcp parts_of(const std::string& words) {
  const std::size_t colon = words.rfind(':');
  const std::int64_t port =
      text::integer(colon == std::string::npos ? std::string() : words.substr(colon + 1)).value_or(-1);
  std::string host = words.substr(0, colon == std::string::npos ? 0 : colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  if (host.empty() || port < 0 || port > 65535) {
    throw Error(ErrorCode::kUsage, fmt::format("tcp:{} is no address", words),
                "give tcp:HOST:PORT, with port 0 for any, or unix:PATH");
  }
  return {host, std::to_string(port)};
}

int bound(const addrinfo& where) {
  const int made =
      ::socket(where.ai_family, where.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, where.ai_protocol);
  if (made < 0) return -1;
  // Connections inherit both: small messages are not held back, and an engine can start where one just ended.
  const int on = 1;
  ::setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  ::setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  if (::bind(made, where.ai_addr, where.ai_addrlen) == 0 && ::listen(made, kBacklog) == 0) return made;
  const int trouble = errno;
  ::close(made);
  errno = trouble;
  return -1;
}

int port_of(int descriptor) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw io_error("ask for the port of", "the engine's socket", errno);
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                             : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

}  // namespace

Listener::Listener(const std::string& listen, std::size_t most_connections) : most_(most_connections) {
  constexpr std::string_view kUnix = "unix:";
  constexpr std::string_view kTcp = "tcp:";
  if (listen.starts_with(kUnix)) {
    listen_unix(listen.substr(kUnix.size()));
  } else if (listen.starts_with(kTcp)) {
    const Tcp tcp = parts_of(listen.substr(kTcp.size()));
    listen_tcp(tcp.host, tcp.port);
  } else {
    throw Error(ErrorCode::kUsage, fmt::format("\"{}\" is no address to listen at", listen),
                "give unix:PATH or tcp:HOST:PORT");
  }
}

Listener::~Listener() {
  ::close(listening_);
  struct stat facts = {};
  if (is_unix() && ::lstat(socket_file_.c_str(), &facts) == 0 && facts.st_ino == socket_inode_)
    ::unlink(socket_file_.c_str());
}

void Listener::listen_unix(const std::string& path) {
  const sockaddr_un address = unix_address(path);
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  require_private_folder(folder);
  remove_dead(path, address);
  const int made = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (made < 0) throw io_error("make a socket for", path, errno);
  struct stat facts = {};
  // The folder keeps others out until the mode is set.
  if (::bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      ::chmod(path.c_str(), 0600) != 0 || ::listen(made, kBacklog) != 0 ||
      ::lstat(path.c_str(), &facts) != 0) {
    const Error error = io_error("listen at", path, errno);
    ::close(made);
    throw error;
  }
  listening_ = made;
  socket_file_ = path;
  socket_inode_ = facts.st_ino;
  address_ = "unix:" + path;
}

void Listener::listen_tcp(const std::string& host, const std::string& port) {
  addrinfo wanted = {};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE;
  addrinfo* list = nullptr;
  if (const int code = ::getaddrinfo(host.c_str(), port.c_str(), &wanted, &list); code != 0) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} is no host of this machine: {}", host, ::gai_strerror(code)),
                "127.0.0.1 serves this machine alone, 0.0.0.0 all networks");
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> found(list, ::freeaddrinfo);
  for (const addrinfo* where = list; where != nullptr && listening_ < 0; where = where->ai_next)
    listening_ = bound(*where);
  if (listening_ < 0) {
    const int trouble = errno;
    throw Error(ErrorCode::kEngine,
                fmt::format("cannot listen at tcp:{}:{}: {}", host, port, std::strerror(trouble)),
                "name another port, or 0 for any");
  }
  const bool is_ipv6 = host.find(':') != std::string::npos;
  address_ = fmt::format(fmt::runtime(is_ipv6 ? "tcp:[{}]:{}" : "tcp:{}:{}"), host, port_of(listening_));
}

bool Listener::is_welcome(int connection) const {
  if (!is_unix()) return true;
  ucred peer = {};
  socklen_t size = sizeof(peer);
  return ::getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
         (peer.uid == ::geteuid() || peer.uid == 0);
}

std::size_t Listener::connections() {
  std::erase_if(open_, [](const Open& one) { return inode_of(one.descriptor) != one.inode; });
  return open_.size();
}

int Listener::accept() {
  for (;;) {
    const int connection = ::accept4(listening_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (connection < 0) {
      if (errno == EINTR || errno == ECONNABORTED) continue;
      return -1;  // none waits, or this process has no more files: the next turn tries again
    }
    const auto inode = inode_of(connection);
    if (inode && (open_.size() < most_ || connections() < most_) && is_welcome(connection)) {
      open_.push_back({connection, *inode});
      return connection;
    }
    ::close(connection);
  }
}

}  // namespace footwall::service
