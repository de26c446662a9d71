#include "engine/service/resident/far_line.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "storage/base/error.h"

namespace footwall::service {
namespace {

using Clock = std::chrono::steady_clock;
using Half = std::span<const std::uint8_t>;

constexpr std::size_t kMostAddresses = 64;  // the bits of ways_to()
constexpr std::size_t kMostStrangers = 256;
constexpr int kBacklog = 4096;
constexpr std::size_t kHalf = LineSecret().size() / 2;

Half of_caller(const LineSecret& secret) {
  return Half(secret).first(kHalf);
}
Half of_answer(const LineSecret& secret) {
  return Half(secret).last(kHalf);
}

// A line that nobody uses for hours is kept in the tables of what lies between.
constexpr int kKeepAliveSeconds = 60;

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

SocketAddress socket_address(const HostAddress& address) {
  SocketAddress made;
  if (address.family == AF_INET) {
    sockaddr_in four{};
    four.sin_family = AF_INET;
    four.sin_port = htons(address.port);
    std::memcpy(&four.sin_addr, address.bytes.data(), sizeof four.sin_addr);
    std::memcpy(&made.storage, &four, made.size = sizeof four);
  } else {
    sockaddr_in6 six{};
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(address.port);
    std::memcpy(&six.sin6_addr, address.bytes.data(), sizeof six.sin6_addr);
    std::memcpy(&made.storage, &six, made.size = sizeof six);
  }
  return made;
}

// The bytes of an address or of a network's mask.
std::array<std::uint8_t, 16> bytes_of(const sockaddr* from) {
  std::array<std::uint8_t, 16> bytes{};
  if (from->sa_family == AF_INET) {
    sockaddr_in four{};
    std::memcpy(&four, from, sizeof four);
    std::memcpy(bytes.data(), &four.sin_addr, sizeof four.sin_addr);
  } else {
    sockaddr_in6 six{};
    std::memcpy(&six, from, sizeof six);
    std::memcpy(bytes.data(), &six.sin6_addr, sizeof six.sin6_addr);
  }
  return bytes;
}

std::string in_words(const HostAddress& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  inet_ntop(address.family, address.bytes.data(), text.data(), text.size());
  return text.data();
}

bool is_loopback(const HostAddress& address) {
  if (address.family == AF_INET) return address.bytes[0] == 127;
  return std::memcmp(address.bytes.data(), &in6addr_loopback, address.bytes.size()) == 0;
}

bool is_link_local(const HostAddress& address) {
  return address.family == AF_INET6 && address.bytes[0] == 0xfe && (address.bytes[1] & 0xc0U) == 0x80;
}

bool is_same(const HostAddress& a, const HostAddress& b) {
  return a.family == b.family && a.bytes == b.bytes;
}

bool in_one_network(const HostAddress& a, const HostAddress& b) {
  if (a.family != b.family || a.mask != b.mask) return false;
  for (std::size_t n = 0; n < a.bytes.size(); ++n) {
    if (((a.bytes[n] ^ b.bytes[n]) & a.mask[n]) != 0) return false;
  }
  return true;
}

int milliseconds_until(Clock::time_point end) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
  return static_cast<int>(std::max<std::int64_t>(left, 0));
}

// Whether something happens in time.
bool comes(int connection, short what, Clock::time_point end) {
  for (;;) {
    pollfd wanted{connection, what, 0};
    const int found = poll(&wanted, 1, milliseconds_until(end));
    if (found < 0 && errno == EINTR) continue;
    return found > 0;
  }
}

void set(int connection, int level, int option, int value) {
  if (setsockopt(connection, level, option, &value, sizeof value) != 0)
    throw io_error("set up", "a connection to another host", errno);
}

// What comes is told once there is a whole half of a secret.
void await_half(int connection) {
  set(connection, SOL_SOCKET, SO_RCVLOWAT, kHalf);
}

// In a time that does not depend on what was said.
bool says(int connection, Half expected) {
  std::array<std::uint8_t, kHalf> said{};
  if (recv(connection, said.data(), said.size(), MSG_DONTWAIT) != kHalf) return false;
  unsigned different = 0;
  for (std::size_t n = 0; n < kHalf; ++n) different |= static_cast<unsigned>(said[n] ^ expected[n]);
  return different == 0;
}

bool say(int connection, Half half) {
  return send(connection, half.data(), half.size(), MSG_NOSIGNAL | MSG_DONTWAIT) == kHalf;
}

// From here on it carries words, for as long as the engine lives.
void settle(int connection) {
  set(connection, SOL_SOCKET, SO_RCVLOWAT, 1);
  set(connection, IPPROTO_TCP, TCP_NODELAY, 1);
  set(connection, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(connection, IPPROTO_TCP, TCP_KEEPIDLE, kKeepAliveSeconds);
  const int flags = fcntl(connection, F_GETFL);
  if (flags < 0 || fcntl(connection, F_SETFL, flags & ~O_NONBLOCK) != 0)
    throw io_error("set up", "a connection to another host", errno);
}

// Empty where nobody there knows the secret.
std::optional<Descriptor> line_to(const HostAddress& address, const LineSecret& secret,
                                  Clock::time_point end) {
  Descriptor line(socket(address.family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (line.get() < 0) return std::nullopt;
  const SocketAddress there = socket_address(address);
  if (connect(line.get(), there.get(), there.size) != 0 && errno != EINPROGRESS) return std::nullopt;
  int failure = 0;
  socklen_t size = sizeof failure;
  if (!comes(line.get(), POLLOUT, end) ||
      getsockopt(line.get(), SOL_SOCKET, SO_ERROR, &failure, &size) != 0 || failure != 0)
    return std::nullopt;
  await_half(line.get());
  if (!say(line.get(), of_caller(secret)) || !comes(line.get(), POLLIN, end) ||
      !says(line.get(), of_answer(secret)))
    return std::nullopt;
  settle(line.get());
  return line;
}

}  // namespace

std::vector<HostAddress> own_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) throw io_error("ask for", "the addresses of this host", errno);
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, freeifaddrs);
  std::vector<HostAddress> found;
  for (const ifaddrs* each = first; each != nullptr && found.size() < kMostAddresses; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_netmask == nullptr || (each->ifa_flags & IFF_UP) == 0)
      continue;
    const int family = each->ifa_addr->sa_family;
    if (family != AF_INET && family != AF_INET6) continue;
    HostAddress address;
    address.family = family;
    address.bytes = bytes_of(each->ifa_addr);
    address.mask = bytes_of(each->ifa_netmask);
    if (!is_link_local(address)) found.push_back(address);
  }
  return found;
}

std::uint64_t ways_to(std::span<const HostAddress> theirs, std::span<const HostAddress> mine) {
  std::uint64_t near = 0;
  std::uint64_t far = 0;
  std::uint64_t loopback = 0;
  for (std::size_t n = 0; n < std::min(theirs.size(), kMostAddresses); ++n) {
    const std::uint64_t bit = std::uint64_t{1} << n;
    const auto any_of_mine = [&](auto&& is) {
      return std::any_of(mine.begin(), mine.end(), [&](const auto& own) { return is(theirs[n], own); });
    };
    if (is_loopback(theirs[n])) {
      loopback |= bit;
    } else if (!any_of_mine(is_same)) {
      far |= bit;
      if (any_of_mine(in_one_network)) near |= bit;
    }
  }
  return near != 0 ? near : far != 0 ? far : loopback;
}

LineSecret new_line_secret() {
  LineSecret secret;
  if (getrandom(secret.data(), secret.size(), 0) != static_cast<ssize_t>(secret.size()))
    throw io_error("read", "random bytes", errno);
  return secret;
}

FarListener::FarListener(std::span<const HostAddress> where) {
  int failure = EADDRNOTAVAIL;
  for (const HostAddress& address : where) {
    Door door{Descriptor(socket(address.family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)), address};
    door.address.port = 0;
    const SocketAddress here = socket_address(door.address);
    SocketAddress made;
    made.size = sizeof made.storage;
    if (door.listening.get() < 0 || bind(door.listening.get(), here.get(), here.size) != 0 ||
        listen(door.listening.get(), kBacklog) != 0 ||
        getsockname(door.listening.get(), reinterpret_cast<sockaddr*>(&made.storage), &made.size) != 0) {
      failure = errno;
      continue;
    }
    in_port_t port = 0;  // at the same place in both kinds
    static_assert(offsetof(sockaddr_in, sin_port) == offsetof(sockaddr_in6, sin6_port));
    std::memcpy(&port, reinterpret_cast<const char*>(&made.storage) + offsetof(sockaddr_in, sin_port),
                sizeof port);
    door.address.port = ntohs(port);
    doors_.push_back(std::move(door));
  }
  if (doors_.empty()) throw io_error("listen on", "this host's addresses", failure);
}

std::vector<HostAddress> FarListener::addresses() const {
  std::vector<HostAddress> all;
  for (const Door& door : doors_) all.push_back(door.address);
  return all;
}

std::vector<Descriptor> FarListener::accept(int lines, const LineSecret& secret,
                                            std::chrono::milliseconds patience) {
  const auto end = Clock::now() + patience;
  std::vector<Descriptor> known;
  std::vector<Descriptor> strangers;  // that have said nothing yet, the oldest first
  while (std::cmp_less(known.size(), lines)) {
    std::vector<pollfd> wanted;
    for (const Door& door : doors_) wanted.push_back({door.listening.get(), POLLIN, 0});
    for (const Descriptor& each : strangers) wanted.push_back({each.get(), POLLIN, 0});
    const int left = milliseconds_until(end);
    const int found = left > 0 ? poll(wanted.data(), wanted.size(), left) : 0;
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) {
      throw Error(ErrorCode::kEngine,
                  fmt::format("{} of {} other hosts reached this one by TCP, at {}", known.size(), lines,
                              in_words(doors_.front().address)),
                  "the engine's hosts must be able to connect to each other");
    }
    std::vector<Descriptor> still_strangers;
    for (std::size_t n = 0; n < strangers.size(); ++n) {
      Descriptor& stranger = strangers[n];
      if (wanted[doors_.size() + n].revents == 0) {
        still_strangers.push_back(std::move(stranger));
      } else if (says(stranger.get(), of_caller(secret)) && say(stranger.get(), of_answer(secret))) {
        settle(stranger.get());
        known.push_back(std::move(stranger));
      }
    }
    strangers = std::move(still_strangers);
    for (std::size_t n = 0; n < doors_.size(); ++n) {
      if (wanted[n].revents == 0) continue;
      Descriptor stranger(accept4(doors_[n].listening.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (stranger.get() < 0) continue;
      await_half(stranger.get());
      if (strangers.size() == kMostStrangers) strangers.erase(strangers.begin());
      strangers.push_back(std::move(stranger));
    }
  }
  return known;
}

Descriptor reach(std::span<const HostAddress> addresses, const LineSecret& secret,
                 std::chrono::milliseconds patience_each) {
  std::string tried;
  for (const HostAddress& address : addresses) {
    if (auto line = line_to(address, secret, Clock::now() + patience_each)) return std::move(*line);
    tried += (tried.empty() ? "" : ", ") + in_words(address);
  }
  throw Error(ErrorCode::kEngine, "the engine's first host cannot be reached by TCP, at " + tried,
              "the engine's hosts must be able to connect to each other");
}

}  // namespace footwall::service
