// What the checks of `footwall doctor` find, one row each.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "storage/base/job_context.h"

namespace footwall::tasks {

enum class Verdict : std::uint8_t { kOk, kWarning, kFailed };

struct Finding {
  std::string name;  // e.g. "shared memory"
  Verdict verdict = Verdict::kOk;
  std::string what;  // one line, with numbers
  std::string hint;  // what to do; empty where there is nothing to do
};

Finding ok(std::string what);
Finding warning(std::string what, std::string hint);
Finding failed(std::string what, std::string hint);

// Runs checks one after another; what a check throws is its finding.
class Checkup {
 public:
  Checkup(const JobContext& job, int expected) : job_(job), expected_(expected) {}

  // False where the check failed. Throws kCancelled.
  bool run(const std::string& name, const std::function<Finding()>& check);
  const JobContext& job() const { return job_; }
  std::vector<Finding> findings() && { return std::move(findings_); }

 private:
  const JobContext& job_;
  int expected_;
  std::vector<Finding> findings_;
};

}  // namespace footwall::tasks
