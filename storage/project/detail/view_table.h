// Cameras by name.
#pragma once
#include <string>
#include <vector>

#include "storage/project/detail/database.h"
#include "storage/project/records.h"

namespace footwall::project::detail {

class ViewTable {
 public:
  explicit ViewTable(Database& database) : database_(database) {}

  std::vector<ViewRecord> all() const;  // by name
  void put(const ViewRecord& view);
  void remove(const std::string& name);

 private:
  Database& database_;
};

}  // namespace footwall::project::detail
