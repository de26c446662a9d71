// The one error story: expected failures (a file, the user's input, a cancelled job, a lost engine) throw
// Error; each program's main catches it once. Broken preconditions of public calls use require().
#pragma once
#include <cstdint>
#include <exception>
#include <string>
#include <string_view>

namespace footwall {

enum class ErrorCode : std::uint8_t {
  kUsage,        // wrong options or values on the command line: exit 2
  kInvalid,      // input that is understood but cannot be used
  kNotFound,     // a file, fault, volume ... that is not there
  kFormat,       // a file that is not what it should be
  kCorrupt,      // a file that was whole once
  kIo,           // the operating system refused
  kHeld,         // somebody else holds the project
  kUnsupported,  // not built, or newer than this program
  kMemory,       // would not fit
  kCancelled,    // exit 130
  kEngine,       // the engine could not be started or died
  kInternal      // a bug of ours
};

// The name used in JSON, e.g. "not_found".
std::string_view name_of(ErrorCode code);
// The inverse; kInternal for a name that is not known.
ErrorCode error_code_from(std::string_view name);

class Error : public std::exception {
 public:
  // message: one line that says what happened, with the names and numbers; hint: how to mend it, may be
  // empty.
  Error(ErrorCode code, std::string message, std::string hint = {});

  ErrorCode code() const noexcept { return code_; }
  const std::string& message() const noexcept { return message_; }
  const std::string& hint() const noexcept { return hint_; }
  const char* what() const noexcept override { return whole_.c_str(); }

 private:
  ErrorCode code_;
  std::string message_;
  std::string hint_;
  std::string whole_;
};

// An always-on check of a public call's precondition: throws kInternal with the caller's file and line. Not
// std::source_location: clang 14, which clang-tidy reads with, cannot compile libstdc++'s.
void require(bool condition, std::string_view what, const char* file = __builtin_FILE(),
             int line = __builtin_LINE());

// Error kIo for the current errno: "cannot <doing> <path>: <reason>".
Error io_error(std::string_view doing, const std::string& path, int error_number);

}  // namespace footwall
