#include "engine/session/report_json.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

Json phases(const extract::Seconds& seconds) {
  return {{"read", seconds.read},
          {"balance", seconds.balance},
          {"voxelize", seconds.voxelize},
          {"exchange", seconds.exchange},
          {"compute", seconds.compute}};
}

Json with_total(const extract::Seconds& seconds) {
  Json json = phases(seconds);
  json["total"] = seconds.total;
  return json;
}

}  // namespace

Json report_json(const extract::Report& report, const extract::Options& options) {
  Json predicted = with_total(report.predicted);
  predicted.erase("read");  // the model knows nothing of it
  return {{"ranks", report.ranks},
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
          {"predicted", std::move(predicted)},
          {"seconds", with_total(report.seconds)},
          {"quickest_seconds", phases(report.quickest)}};
}

}  // namespace footwall::session
