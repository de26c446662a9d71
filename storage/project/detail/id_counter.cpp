#include "storage/project/detail/id_counter.h"

#include <fmt/format.h>
#include <limits>

namespace footwall::project::detail {

std::int64_t IdCounter::next(const std::string& family) {
  const auto known = last_.find(family);
  if (known != last_.end()) return ++known->second;
  Query row(database_, "SELECT last FROM id_counter WHERE family = ?", family);
  const std::int64_t last = row.next() ? row.integer(0) : 0;
  if (last < 0 || last >= std::numeric_limits<std::int64_t>::max() / 2) {
    throw Error(ErrorCode::kCorrupt, fmt::format("the project's counter of {} ids reads {}", family, last),
                "restore the project from a copy");
  }
  return last_[family] = last + 1;
}

void IdCounter::flush() {
  for (const auto& [family, last] : last_) {
    Query(database_, "INSERT OR REPLACE INTO id_counter(family, last) VALUES(?, ?)", family, last).run();
  }
  last_.clear();
}

}  // namespace footwall::project::detail
