// The real files of other projects: in the folder that FOOTWALL_TEST_DATA names, or in ../shared/data beside
// the source tree. MANIFEST.tsv there says what is known about each.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "storage/base/text.h"

namespace footwall::formats {

inline std::filesystem::path real_files() {
  const char* named = std::getenv("FOOTWALL_TEST_DATA");
  return named != nullptr ? std::filesystem::path(named)
                          : std::filesystem::path(FOOTWALL_SOURCE_DIR) / ".." / "shared" / "data";
}

struct RealFile {
  std::filesystem::path path;
  std::string name;      // the path's last part
  std::string category;  // "segy", "fault", ...
  std::string facts;
};

// Rows of the manifest whose file is there.
inline std::vector<RealFile> manifest() {
  std::vector<RealFile> rows;
  std::ifstream in(real_files() / "MANIFEST.tsv");
  for (std::string line; std::getline(in, line);) {
    const auto fields = text::split(line, '\t');
    if (fields.size() < 8) continue;
    const auto path = real_files() / fields[0];
    if (std::filesystem::is_regular_file(path)) {
      rows.push_back({path, path.filename(), std::string(fields[1]), std::string(fields[7])});
    }
  }
  return rows;
}

// The number right after the first `mark` in the facts, as far as it goes; "" where the mark is not there.
inline std::string stated_after(const std::string& facts, const std::string& mark) {
  const std::size_t at = facts.find(mark);
  if (at == std::string::npos) return {};
  const std::size_t from = at + mark.size();
  std::size_t end = std::min(facts.find_first_not_of("-+.e0123456789", from), facts.size());
  end = std::min(end, facts.find("..", from));
  return facts.substr(from, end - from);
}

}  // namespace footwall::formats

#define FOOTWALL_NEEDS_REAL_FILES()                                               \
  if (!std::filesystem::exists(footwall::formats::real_files() / "MANIFEST.tsv")) \
  GTEST_SKIP() << "skipped: no test data in " << footwall::formats::real_files().lexically_normal().string()
