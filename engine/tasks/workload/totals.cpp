#include "engine/tasks/workload/totals.h"

#include <algorithm>
#include <array>

namespace footwall::tasks {

void WorkloadTotals::add(const extract::Result& result, bool incremental) {
  const extract::Report& r = result.report;
  ++extracts_;
  incremental_ += incremental;
  ++exchanges_[r.exchange];
  sum_.faces += r.faces;
  sum_.voxels += r.voxels;
  sum_.bytes_sent += r.bytes_sent;
  sum_.messages += r.messages;
  sum_.cache_hits += r.cache_hits;
  sum_.cache_voxels = std::max(sum_.cache_voxels, r.cache_voxels);
  sum_.seconds.balance += r.seconds.balance;
  sum_.seconds.voxelize += r.seconds.voxelize;
  sum_.seconds.exchange += r.seconds.exchange;
  sum_.seconds.compute += r.seconds.compute;
  max_over_mean_ += r.load_max_over_mean;
  deviation_ += r.load_deviation;
  const std::array<std::uint64_t, 1> statistics{r.checksum};
  hasher_.add(std::as_bytes(std::span(statistics)));
  for (const extract::FaceBlobs& blobs : result.blobs) {
    hasher_.add(std::as_bytes(std::span(blobs.offsets)));
    hasher_.add(blobs.bytes);
  }
}

nlohmann::json WorkloadTotals::json(double slowest, double quickest) const {
  const double extracts = static_cast<double>(std::max<std::int64_t>(1, extracts_));
  return {{"slowest_rank", slowest},
          {"quickest_rank", quickest},
          {"seconds",
           {{"apply", apply_},
            {"balance", sum_.seconds.balance},
            {"voxelize", sum_.seconds.voxelize},
            {"exchange", sum_.seconds.exchange},
            {"compute", sum_.seconds.compute},
            {"total", slowest}}},
          {"extracts", extracts_},
          {"faces", sum_.faces},
          {"voxels", sum_.voxels},
          {"bytes_sent", sum_.bytes_sent},
          {"messages", sum_.messages},
          {"cache_hits", sum_.cache_hits},
          {"cache_voxels", sum_.cache_voxels},
          {"load_max_over_mean", extracts_ > 0 ? max_over_mean_ / extracts : 1.0},
          {"load_deviation", deviation_ / extracts},
          {"checksum", to_hex(checksum())}};
}

}  // namespace footwall::tasks
