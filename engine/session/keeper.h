// The keeper: a process between a program and the launcher of its ranks. Whichever of them is killed, it ends
// the others and takes away what they leave. It has no state but its words, and does nothing while all is
// well.
//
// The program that dies gives the keeper SIGTERM (it is a Child); what the launcher leaves becomes the
// keeper's child; and the launcher gets SIGTERM when the keeper dies, so that the program sees its end.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace footwall::session {

// What is removed when the program is gone, and so could not do it. While it lives it removes them itself.
struct Belongings {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path secret_file;  // removed only where it has the secret; empty: none
  std::filesystem::path lock;         // removed only where nobody locks it (flock()); empty: none
};

// The words that run `command` with a keeper of this process: of `program`, whose main() calls keep().
// secret_variable: the environment variable that has what stands in Belongings::secret_file.
std::vector<std::string> kept_command(const std::filesystem::path& program, const Belongings& belongings,
                                      const std::string& secret_variable,
                                      const std::vector<std::string>& command);

// Whether a program was started as a keeper, which must do nothing else then but keep().
bool is_keeper(std::span<char* const> arguments);
// Returns the exit status of the launcher, 128 + n where signal n killed it. SIGTERM is passed on to it; what
// does not end within two seconds after the program is gone, and all of it at SIGQUIT, is killed. At the
// return no process is left that the launcher started on this host.
int keep(std::span<char* const> arguments);

}  // namespace footwall::session
