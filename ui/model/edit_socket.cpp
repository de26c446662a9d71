#include "ui/model/edit_socket.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "engine/tasks/edit_at_holder.h"
#include "engine/tasks/edit_script.h"
#include "storage/base/error.h"

namespace footwall::ui {
namespace {

constexpr std::size_t kLongestLine = std::size_t{17}
                                     << 20;  // a little more than apply_edit_script() lets through
constexpr std::size_t kMostWaiting = std::size_t{4} << 20;  // answers that the peer does not read
constexpr int kTurnMs = 20;                                 // then the window has its turn

bool is_of_this_user(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == ::geteuid();
}

}  // namespace

EditSocket::EditSocket(QObject* parent)
    : QObject(parent), folder_(session::temporary_home()), path_((folder_.path() / "edits").string()) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) throw io_error("listen at", path_, ENAMETOOLONG);
  std::memcpy(address.sun_path, path_.data(), path_.size());
  listening_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (listening_ < 0) throw io_error("open the socket", path_, errno);
  if (::bind(listening_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listening_, 8) != 0) {
    const int reason = errno;
    ::close(listening_);
    throw io_error("listen at", path_, reason);
  }
}

EditSocket::~EditSocket() {
  while (!peers_.empty()) drop(peers_.begin()->first);
  arrivals_.reset();
  ::close(listening_);
}

void EditSocket::serve(Document& document) {
  document_ = &document;
  arrivals_ = std::make_unique<QSocketNotifier>(listening_, QSocketNotifier::Read);
  connect(arrivals_.get(), &QSocketNotifier::activated, this, [this] { take_connections(); });
}

void EditSocket::take_connections() {
  for (;;) {
    const int socket = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (socket < 0) return;
    if (!is_of_this_user(socket)) {
      ::close(socket);
      continue;
    }
    Peer& peer = peers_[socket];
    peer.readable = std::make_unique<QSocketNotifier>(socket, QSocketNotifier::Read);
    peer.writable = std::make_unique<QSocketNotifier>(socket, QSocketNotifier::Write);
    peer.writable->setEnabled(false);
    // Queued: a notifier must not be destroyed from within its own signal.
    connect(
        peer.readable.get(), &QSocketNotifier::activated, this, [this, socket] { read_from(socket); },
        Qt::QueuedConnection);
    connect(
        peer.writable.get(), &QSocketNotifier::activated, this, [this, socket] { send_to(socket); },
        Qt::QueuedConnection);
  }
}

void EditSocket::read_from(int socket) {
  const auto found = peers_.find(socket);
  if (found == peers_.end() || found->second.ends) return;
  Peer& peer = found->second;
  char buffer[65536];
  const ssize_t n = ::recv(socket, buffer, sizeof buffer, 0);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (n <= 0) return drop(socket);
  peer.received.append(buffer, static_cast<std::size_t>(n));
  apply_lines(socket);
}

void EditSocket::apply_lines(int socket) {
  const auto found = peers_.find(socket);
  if (found == peers_.end()) return;
  Peer& peer = found->second;
  QElapsedTimer turn;
  turn.start();
  std::size_t end = 0;
  while (!peer.ends && (end = peer.received.find('\n')) != std::string::npos) {
    const std::string line = peer.received.substr(0, end);
    peer.received.erase(0, end + 1);
    peer.to_send += answer_to(line, peer.ends) + '\n';
    if (turn.elapsed() < kTurnMs) continue;
    QMetaObject::invokeMethod(
        this, [this, socket] { apply_lines(socket); }, Qt::QueuedConnection);
    break;
  }
  if (peer.received.size() > kLongestLine || peer.to_send.size() > kMostWaiting) return drop(socket);
  send_to(socket);
}

std::string EditSocket::answer_to(std::string_view line, bool& failed) {
  std::int64_t number = 0;
  const auto [rest, problem] = std::from_chars(line.data(), line.data() + line.size(), number);
  try {
    if (problem != std::errc() || rest == line.data() + line.size() || *rest != ' ')
      throw Error(ErrorCode::kFormat, "a line must begin with its number");
    const std::string_view content = line.substr(static_cast<std::size_t>(rest - line.data()) + 1);
    const auto reply = tasks::apply_edit_line(document_->store(), content, number);
    document_->refresh_interpretation();
    return reply.dump();
  } catch (const Error& error) {
    failed = true;
    return tasks::edit_failure(error).dump();
  } catch (const std::exception& error) {
    failed = true;
    return tasks::edit_failure({ErrorCode::kInternal, error.what()}).dump();
  }
}

void EditSocket::send_to(int socket) {
  const auto found = peers_.find(socket);
  if (found == peers_.end()) return;
  Peer& peer = found->second;
  while (!peer.to_send.empty()) {
    const ssize_t n = ::send(socket, peer.to_send.data(), peer.to_send.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) break;
    if (n <= 0) return drop(socket);
    peer.to_send.erase(0, static_cast<std::size_t>(n));
  }
  peer.writable->setEnabled(!peer.to_send.empty());
  if (peer.ends && peer.to_send.empty()) drop(socket);
}

void EditSocket::drop(int socket) {
  const auto found = peers_.find(socket);
  if (found == peers_.end()) return;
  found->second.readable->setEnabled(false);
  found->second.writable->setEnabled(false);
  peers_.erase(found);
  ::close(socket);
}

}  // namespace footwall::ui
