// A child process whose output comes line by line, and which does not outlive the thread that started it.
#pragma once
#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace footwall::session {

class Child {
 public:
  // Starts command[0] (looked up in PATH) in a process group of its own, with the environment of this process
  // and `settings` ("NAME=value"); its standard input is empty, its output and errors come together. Throws
  // Error kEngine where it cannot be started.
  Child(const std::vector<std::string>& command, const std::vector<std::string>& settings);
  // Kills and reaps what still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Waits up to timeout_ms for output and hands over each whole line; false once the output has ended.
  bool read_lines(int timeout_ms, const std::function<void(const std::string&)>& line);
  void signal(int number) const;  // to the child
  void kill_group() const;        // to it and its group, at once
  // Waits for its end; the status as waitpid() gives it.
  int wait();

 private:
  pid_t process_ = -1;
  int output_ = -1;
  std::string pending_;
};

}  // namespace footwall::session
