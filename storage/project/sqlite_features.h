// What the SQLite library that this program runs with can do.
#pragma once
#include <string>
#include <vector>

namespace footwall::project {

struct SqliteFeatures {
  std::string running;               // version, e.g. "3.40.1"
  std::vector<std::string> missing;  // what a project needs and this library has not, in words
};
SqliteFeatures sqlite_features();

}  // namespace footwall::project
