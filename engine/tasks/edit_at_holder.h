// Edits for a project that another program of this machine holds: it is asked to make them, over the socket
// that the project's lock names.
//
// The holder is sent "NUMBER LINE\n", a line of edit_script.h under its number, and answers each with one
// line of JSON: the reply, or {"error":{"code","message","hint"}}, after which it hears no more.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "storage/base/error.h"

namespace footwall::tasks {

class EditAtHolder {
 public:
  // Throws kHeld where nobody listens there, or somebody who is another user.
  explicit EditAtHolder(const std::string& socket);
  ~EditAtHolder();
  EditAtHolder(const EditAtHolder&) = delete;
  EditAtHolder& operator=(const EditAtHolder&) = delete;

  // Waits for the answer. Throws what the edit throws there, with "line N: " as apply_edit_line() does, and
  // kHeld when the holder goes away; whether the line was applied is not known then.
  nlohmann::json apply(std::string_view line, std::int64_t line_number);

 private:
  int socket_ = -1;
  std::string received_;
};

nlohmann::json edit_failure(const Error& error);

}  // namespace footwall::tasks
