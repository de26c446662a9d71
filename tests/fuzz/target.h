// What a fuzz target tells the driver; each target is one file that defines fuzz_target().
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace footwall::fuzz {

struct Target {
  // Files of the test data to start from, relative to its folder: a path, or FOLDER/*.EXTENSION. Files above
  // 32 KiB are left out, since a change would seldom hit what matters.
  std::vector<std::string> files;
  // Inputs made by the target, so that it also has some where the test data are absent. At least one.
  std::vector<std::string> made;
  // Reads the bytes as a file of the kind. May throw footwall::Error; anything else is a failure. Returns
  // false where the result breaks a promise of the reader.
  std::function<bool(const std::string& bytes)> run;
};

Target fuzz_target();

}  // namespace footwall::fuzz
