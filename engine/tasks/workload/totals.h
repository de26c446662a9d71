// What the EXTRACT-ALLs of a workload cost together.
#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "engine/extract/extract.h"
#include "storage/base/hash.h"

namespace footwall::tasks {

class WorkloadTotals {
 public:
  // The results' blobs, too, enter the checksum; they are on rank 0 alone, and so is a checksum that means
  // something.
  void add(const extract::Result& result, bool incremental);
  void add_apply_seconds(double slowest) { apply_ += slowest; }

  std::uint64_t checksum() const { return hasher_.value(); }
  // The keys of run_parallel.h that are sums and means over EXTRACT-ALLs; `total` seconds are the slowest
  // rank's.
  nlohmann::json json(double slowest, double quickest) const;
  nlohmann::json exchanges() const { return exchanges_; }
  std::int64_t incremental() const { return incremental_; }

 private:
  extract::Report sum_;
  double apply_ = 0;
  double max_over_mean_ = 0, deviation_ = 0;  // sums
  std::int64_t extracts_ = 0, incremental_ = 0;
  std::map<std::string, std::int64_t> exchanges_;
  Hasher hasher_;
};

}  // namespace footwall::tasks
