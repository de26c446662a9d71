// Numbers that are handed out once: ids of faults, pillars, nodes and surfaces, and shape revisions. The
// counters stand outside undo, so that a number taken back by undo is not given to something else.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "storage/project/detail/database.h"

namespace footwall::project::detail {

class IdCounter {
 public:
  explicit IdCounter(Database& database) : database_(database) {}
  // family: fault, pillar, pillar_node, surface, revision.
  std::int64_t next(const std::string& family);
  // Writes the counters that moved; before the commit.
  void flush();

 private:
  Database& database_;
  std::map<std::string, std::int64_t> last_;
};

}  // namespace footwall::project::detail
