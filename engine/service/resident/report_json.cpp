#include "engine/service/resident/report_json.h"

#include <nlohmann/json.hpp>

namespace footwall::service {
namespace {

nlohmann::json phases(const extract::Seconds& seconds) {
  return {{"read", seconds.read},         {"balance", seconds.balance}, {"voxelize", seconds.voxelize},
          {"exchange", seconds.exchange}, {"compute", seconds.compute}, {"total", seconds.total}};
}

}  // namespace

std::string report_json(const extract::Report& report, const extract::Options& options) {
  nlohmann::json predicted = phases(report.predicted);
  predicted.erase("read");  // the model knows nothing of it
  return nlohmann::json{{"ranks", report.ranks},
                        {"threads", report.threads},
                        {"exchange", report.exchange},
                        {"balance", report.balance},
                        {"voxelizer", options.voxelizer},
                        {"faces", report.faces},
                        {"voxels", report.voxels},
                        {"bytes_sent", report.bytes_sent},
                        {"messages", report.messages},
                        {"load_max_over_mean", report.load_max_over_mean},
                        {"load_deviation", report.load_deviation},
                        {"pillars", options.pillars},
                        {"cache_hits", report.cache_hits},
                        {"cache_voxels", report.cache_voxels},
                        {"reason", report.reason},
                        {"predicted", predicted},
                        {"seconds", phases(report.seconds)},
                        {"quickest_seconds", phases(report.quickest)}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace footwall::service
