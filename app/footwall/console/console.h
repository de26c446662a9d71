// What a command talks to: the job with its progress line, and where its result goes.
#pragma once
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::console {

using Json = nlohmann::ordered_json;

// A command's answer: the object that --json prints, and the same for a person.
struct Output {
  Json json;
  std::string text;
  int status =
      0;  // exit status: 1 where the answer is a "no" (not an error), 75 where it goes on when run again
};

class Console {
 public:
  // With quiet no progress is shown.
  explicit Console(bool quiet);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  // Cancelled by Ctrl+C and SIGTERM as long as this console lives.
  const JobContext& job() const { return job_; }
  // Removes the progress bar, so that what follows starts on a clean line.
  void end_progress();

 private:
  struct Shown;
  std::shared_ptr<Shown> shown_;
  JobContext job_;
};

// The exit status (docs/commands.md) for an error: 2 wrong usage, 130 cancelled, 1 anything else.
int exit_status(ErrorCode code);
// {error:{code,message,hint}}
Json error_json(const Error& error);

}  // namespace footwall::console
