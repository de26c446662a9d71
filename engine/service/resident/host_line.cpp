#include "engine/service/resident/host_line.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "storage/base/error.h"

namespace footwall::service {
namespace {

constexpr int kBacklog = 4096;

sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.size() >= sizeof address.sun_path) {
    throw Error(ErrorCode::kUsage,
                fmt::format("the engine's folder {} has too long a path for a socket: {} of at most {} bytes",
                            path.parent_path().string(), text.size(), sizeof address.sun_path - 1),
                "give it a folder with a shorter path, by TMPDIR");
  }
  std::memcpy(address.sun_path, text.c_str(), text.size() + 1);
  return address;
}

Descriptor new_socket(const std::filesystem::path& path) {
  Descriptor made(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (made.get() < 0) throw io_error("make the socket", path.string(), errno);
  return made;
}

bool is_of_this_user(int connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == geteuid();
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

HostLineLeader::HostLineLeader(const std::filesystem::path& path) : path_(path) {
  const sockaddr_un address = address_of(path);
  listening_ = new_socket(path);
  unlink(path.c_str());  // of an engine that was killed
  const auto* as_any = reinterpret_cast<const sockaddr*>(&address);
  if (bind(listening_.get(), as_any, sizeof address) != 0 || chmod(path.c_str(), S_IRUSR | S_IWUSR) != 0 ||
      listen(listening_.get(), kBacklog) != 0) {
    throw io_error("make the socket", path.string(), errno);
  }
}

void HostLineLeader::accept(int members, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::cmp_less(members_.size(), members)) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
    pollfd wanted{listening_.get(), POLLIN, 0};
    const int found = left > 0 ? poll(&wanted, 1, static_cast<int>(left)) : 0;
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) {
      throw Error(
          ErrorCode::kEngine,
          fmt::format("{} of {} ranks of this host came to {}", members_.size(), members, path_.string()),
          "start the engine again");
    }
    Descriptor member(accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (member.get() >= 0 && is_of_this_user(member.get())) members_.push_back(std::move(member));
  }
  unlink(path_.c_str());
  listening_ = Descriptor();
}

void HostLineLeader::send(std::uint64_t word) const {
  bool all = true;
  for (auto member = members_.rbegin(); member != members_.rend(); ++member)
    all &= ::send(member->get(), &word, sizeof word, MSG_NOSIGNAL | MSG_DONTWAIT) == sizeof word;
  if (!all) throw Error(ErrorCode::kEngine, "a rank has gone", "start the engine again");
}

HostLineMember::HostLineMember(const std::filesystem::path& path) {
  const sockaddr_un address = address_of(path);
  socket_ = new_socket(path);
  if (connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw io_error("reach the socket", path.string(), errno);
}

std::optional<std::uint64_t> HostLineMember::receive() const {
  std::uint64_t word = 0;
  for (;;) {
    const ssize_t got = recv(socket_.get(), &word, sizeof word, MSG_WAITALL);
    if (got == sizeof word) return word;
    if (got < 0 && errno == EINTR) continue;
    return std::nullopt;
  }
}

void HostLineMember::hang_up() const {
  shutdown(socket_.get(), SHUT_RDWR);
}

}  // namespace footwall::service
