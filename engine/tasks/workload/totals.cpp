#include "engine/tasks/workload/totals.h"

#include <algorithm>
#include <array>

namespace footwall::tasks {
namespace {

void add_phases(const extract::Seconds& seconds, extract::Seconds& sum) {
  sum.balance += seconds.balance;
  sum.voxelize += seconds.voxelize;
  sum.exchange += seconds.exchange;
  sum.compute += seconds.compute;
  sum.wait += seconds.wait;
}

nlohmann::json phases(const extract::Seconds& seconds) {
  return {{"balance", seconds.balance},
          {"voxelize", seconds.voxelize},
          {"exchange", seconds.exchange},
          {"compute", seconds.compute},
          {"wait", seconds.wait}};
}

}  // namespace

void WorkloadTotals::add(const extract::Result& result) {
  const extract::Report& r = result.report;
  ++extracts_;
  ++exchanges_[r.exchange];
  ++balances_[r.balance];
  sum_.faces += r.faces;
  sum_.voxels += r.voxels;
  sum_.bytes_sent += r.bytes_sent;
  sum_.messages += r.messages;
  sum_.most_bytes += r.most_bytes;
  sum_.most_messages += r.most_messages;
  sum_.cache_hits += r.cache_hits;
  sum_.cache_voxels = std::max(sum_.cache_voxels, r.cache_voxels);
  add_phases(r.seconds, sum_.seconds);
  add_phases(r.quickest, sum_.quickest);
  add_phases(r.predicted, sum_.predicted);
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
  nlohmann::json seconds = phases(sum_.seconds);
  seconds["apply"] = apply_;
  seconds["total"] = slowest;
  return {{"slowest_rank", slowest},
          {"quickest_rank", quickest},
          {"seconds", seconds},
          {"quickest", phases(sum_.quickest)},
          {"predicted", phases(sum_.predicted)},
          {"extracts", extracts_},
          {"faces", sum_.faces},
          {"voxels", sum_.voxels},
          {"bytes_sent", sum_.bytes_sent},
          {"messages", sum_.messages},
          {"most_bytes_sent", sum_.most_bytes},
          {"most_messages", sum_.most_messages},
          {"cache_hits", sum_.cache_hits},
          {"cache_voxels", sum_.cache_voxels},
          {"load_max_over_mean", extracts_ > 0 ? max_over_mean_ / extracts : 1.0},
          {"load_deviation", deviation_ / extracts},
          {"checksum", to_hex(checksum())}};
}

}  // namespace footwall::tasks
