// The volumes that belong to the project; their samples are HDF5 files beside it.
#pragma once
#include <string>
#include <vector>

#include "storage/project/detail/database.h"

namespace footwall::project::detail {

class VolumeTable {
 public:
  explicit VolumeTable(Database& database) : database_(database) {}
  std::vector<VolumeRecord> all() const;
  // By name; an empty name means the first. Throws kNotFound listing the names.
  VolumeRecord find(const std::string& name) const;
  std::int64_t add(const VolumeRecord& volume);
  void update(const VolumeRecord& volume);
  void remove(std::int64_t id);

 private:
  Database& database_;
};

}  // namespace footwall::project::detail
