#include "engine/session/fault_summary.h"

#include <cmath>

#include "storage/base/error.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

double number_from(const Json& json) {
  return json.is_null() ? extract::kUndefined : json.get<double>();
}

}  // namespace

Json fault_summary(const extract::FaceStatistics& whole) {
  return {{"count", whole.count},
          {"nulls", whole.nulls},
          {"outside", static_cast<int>(whole.outside)},
          {"mean", number(whole.mean)},
          {"variance", number(whole.variance)},
          {"min", number(whole.min)},
          {"max", number(whole.max)},
          {"discontinuity", number(whole.discontinuity)}};
}

extract::FaceStatistics fault_from_summary(const Json& json) {
  extract::FaceStatistics whole;
  try {
    json.at("count").get_to(whole.count);
    json.at("nulls").get_to(whole.nulls);
    const int outside = json.at("outside").get<int>();
    if (outside < 0 || outside > 2) throw Error(ErrorCode::kFormat, "a fault is outside in no known way");
    whole.outside = static_cast<extract::Outside>(outside);
    whole.mean = number_from(json.at("mean"));
    whole.variance = number_from(json.at("variance"));
    whole.min = number_from(json.at("min"));
    whole.max = number_from(json.at("max"));
    whole.discontinuity = number_from(json.at("discontinuity"));
  } catch (const Json::exception&) {
    throw Error(ErrorCode::kFormat, "these are no statistics of a fault");
  }
  return whole;
}

}  // namespace footwall::session
