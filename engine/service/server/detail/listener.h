// A socket that listens, and the connections that came through it: no more than so many at a time, so that
// strangers cannot use up the process's files.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace footwall::service {

class Listener {
 public:
  // listen: as ServerOptions. A unix socket gets mode 0600 in a folder that must be private; one that a dead
  // engine left is removed. Throws Error kUsage, kIo, kEngine (somebody listens there).
  Listener(const std::string& listen, std::size_t most_connections);
  // Closes; a unix socket's file is removed, unless another one took its place.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  bool is_unix() const { return !socket_file_.empty(); }
  // With the port that was taken.
  const std::string& address() const { return address_; }
  int descriptor() const { return listening_; }
  // The next connection, non-blocking, -1 where none waits. One too many, or one of another user through a
  // unix socket, is closed at once. The caller owns it; it counts until it is closed.
  int accept();
  std::size_t connections();

 private:
  struct Open {
    int descriptor;
    ino_t inode;
  };
  void listen_unix(const std::string& path);
  void listen_tcp(const std::string& host, const std::string& port);
  bool is_welcome(int connection) const;

  int listening_ = -1;
  std::string address_;
  std::filesystem::path socket_file_;
  ino_t socket_inode_ = 0;
  std::size_t most_;
  std::vector<Open> open_;
};

}  // namespace footwall::service
