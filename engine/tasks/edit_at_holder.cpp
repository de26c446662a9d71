#include "engine/tasks/edit_at_holder.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace footwall::tasks {
namespace {

Error gone() {
  return {ErrorCode::kHeld, "the program that holds the project went away before it answered",
          "footwall history shows what was applied; try again"};
}

// The answer to nobody but the holder: somebody else may have put a socket there.
bool is_of_this_user(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == ::geteuid();
}

}  // namespace

EditAtHolder::EditAtHolder(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const Error silent(ErrorCode::kHeld,
                     fmt::format("the program that holds the project does not answer at {}", path),
                     "close it there, or try again");
  if (path.size() >= sizeof address.sun_path) throw silent;
  std::memcpy(address.sun_path, path.data(), path.size());
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0) throw io_error("open a socket to", path, errno);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      !is_of_this_user(socket_)) {
    ::close(socket_);
    throw silent;
  }
}

EditAtHolder::~EditAtHolder() {
  ::close(socket_);
}

nlohmann::json EditAtHolder::apply(std::string_view line, std::int64_t line_number) {
  const std::string text = fmt::format("{} {}\n", line_number, line);
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw gone();
    sent += static_cast<std::size_t>(n);
  }
  std::size_t end = std::string::npos;
  while ((end = received_.find('\n')) == std::string::npos) {
    char buffer[4096];
    const ssize_t n = ::recv(socket_, buffer, sizeof buffer, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw gone();
    received_.append(buffer, static_cast<std::size_t>(n));
  }
  const auto reply = nlohmann::json::parse(received_.substr(0, end), nullptr, false);
  received_.erase(0, end + 1);
  if (!reply.is_object()) throw gone();
  const auto error = reply.find("error");
  if (error == reply.end()) return reply;
  if (!error->is_object()) throw gone();
  throw Error(error_code_from(error->value("code", "")), error->value("message", ""),
              error->value("hint", ""));
}

nlohmann::json edit_failure(const Error& error) {
  return {{"error", {{"code", name_of(error.code())}, {"message", error.message()}, {"hint", error.hint()}}}};
}

}  // namespace footwall::tasks
