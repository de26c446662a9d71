// What one check of `footwall doctor` found.
#pragma once
#include <cstdint>
#include <string>

namespace footwall::tasks {

enum class Verdict : std::uint8_t { kOk, kWarning, kFailed };

struct Finding {
  std::string name;  // e.g. "shared memory"
  Verdict verdict = Verdict::kOk;
  std::string what;  // one line, with numbers
  std::string hint;  // what to do; empty where there is nothing to do
};

}  // namespace footwall::tasks
