#include "engine/session/fault_summary.h"

#include <cmath>

#include "engine/extract/face_numbers.h"
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
  Json json{{"count", whole.count}, {"nulls", whole.nulls}, {"outside", static_cast<int>(whole.outside)}};
  for (const extract::FaceNumber& each : extract::kFaceNumbers) {
    if (each.of_faults) json[std::string(each.name)] = number(whole.*each.member);
  }
  return json;
}

extract::FaceStatistics fault_from_summary(const Json& json) {
  extract::FaceStatistics whole;
  try {
    json.at("count").get_to(whole.count);
    json.at("nulls").get_to(whole.nulls);
    const int outside = json.at("outside").get<int>();
    if (outside < 0 || outside > 2) throw Error(ErrorCode::kFormat, "a fault is outside in no known way");
    whole.outside = static_cast<extract::Outside>(outside);
    for (const extract::FaceNumber& each : extract::kFaceNumbers) {
      if (each.of_faults) whole.*each.member = number_from(json.at(std::string(each.name)));
    }
  } catch (const Json::exception&) {
    throw Error(ErrorCode::kFormat, "these are no statistics of a fault");
  }
  return whole;
}

}  // namespace footwall::session
