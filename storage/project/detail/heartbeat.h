// Touches an open file every kLeaseRenewSeconds, by the clock of the file's server, for as long as it lives.
#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace footwall::project::detail {

class Heartbeat {
 public:
  // file: stays open as long as this lives. what: for the warning when it cannot be touched.
  Heartbeat(int file, std::string what);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

 private:
  void beat();
  int file_;
  std::string what_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace footwall::project::detail
