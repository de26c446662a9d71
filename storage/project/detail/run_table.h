// Statistics by name, and the EXTRACT-ALL runs that hold their values: one float64 blob per statistic, run
// and fault.
#pragma once
#include <span>
#include <vector>

#include "storage/project/detail/database.h"

namespace footwall::project::detail {

class RunTable {
 public:
  explicit RunTable(Database& database) : database_(database) {}

  std::vector<StatisticRecord> statistics() const;
  void put(const StatisticRecord& statistic);

  std::vector<RunRecord> all() const;
  std::vector<std::int64_t> faults(std::int64_t run) const;
  // Throws kNotFound, kCorrupt.
  FaultRun read(std::int64_t run, std::int64_t fault) const;
  // Throws kCorrupt.
  std::vector<FaceVoxels> voxels(std::int64_t run, std::int64_t fault) const;
  // Throws kInvalid where the vectors differ in length or a statistic is not registered.
  std::int64_t add(const RunRecord& run, std::span<const FaultRun> faults);
  // An empty name: as a run is called that got none.
  void rename(std::int64_t run, const std::string& name);
  void remove(std::int64_t run);

 private:
  void add_fault(std::int64_t run, const FaultRun& fault);
  void add_voxels(std::int64_t run, const FaultRun& fault, const FaceVoxels& voxels);
  Database& database_;
};

}  // namespace footwall::project::detail
