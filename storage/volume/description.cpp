#include "storage/volume/description.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/survey/geometry_json.h"

namespace footwall::volume {
namespace {

using nlohmann::json;

json statistics_json(const Statistics& s) {
  return {{"min", s.min},
          {"max", s.max},
          {"mean", s.mean},
          {"stddev", s.stddev},
          {"max_abs", s.max_abs},
          {"count", s.count},
          {"null_count", s.null_count},
          {"live_traces", s.live_traces},
          {"percentiles", s.percentiles},
          {"histogram", {{"lo", s.histogram.lo}, {"hi", s.histogram.hi}, {"counts", s.histogram.counts}}}};
}

Statistics statistics_from(const json& j) {
  Statistics s;
  s.min = j.at("min").get<double>();
  s.max = j.at("max").get<double>();
  s.mean = j.at("mean").get<double>();
  s.stddev = j.at("stddev").get<double>();
  s.max_abs = j.at("max_abs").get<double>();
  s.count = j.at("count").get<std::int64_t>();
  s.null_count = j.at("null_count").get<std::int64_t>();
  s.live_traces = j.at("live_traces").get<std::int64_t>();
  s.percentiles = j.at("percentiles").get<std::vector<double>>();
  const json& histogram = j.at("histogram");
  s.histogram.lo = histogram.at("lo").get<double>();
  s.histogram.hi = histogram.at("hi").get<double>();
  const auto counts = histogram.at("counts").get<std::vector<std::int64_t>>();
  if (s.percentiles.size() != 101 || counts.size() != Histogram::kBins) {
    throw Error(ErrorCode::kFormat, "statistics need 101 percentiles and 256 histogram counts");
  }
  std::copy(counts.begin(), counts.end(), s.histogram.counts.begin());
  return s;
}

}  // namespace

std::string_view name_of(Role role) {
  switch (role) {
    case Role::kAmplitude:
      return "amplitude";
    case Role::kDiscontinuity:
      return "discontinuity";
    case Role::kOther:
      break;
  }
  return "other";
}

Role role_from(std::string_view name) {
  for (const Role role : {Role::kAmplitude, Role::kDiscontinuity, Role::kOther}) {
    if (name == name_of(role)) return role;
  }
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is not a role of a volume", name),
              "use amplitude, discontinuity or other");
}

const std::vector<std::string>& description_names() {
  static const std::vector<std::string> names{"format",     "version",       "geometry",   "origin",
                                              "role",       "high_is_fault", "null_value", "source",
                                              "provenance", "statistics",    "checksum"};
  return names;
}

Description describe(const VolumeInfo& info) {
  if (!json::accept(info.provenance_json)) {
    throw Error(ErrorCode::kInvalid, "the volume's provenance is not JSON");
  }
  if (info.null_value && std::isinf(*info.null_value)) {
    throw Error(ErrorCode::kInvalid, "the null value is infinite",
                "leave it out: infinities always count as null");
  }
  const bool has_null_value = info.null_value && !std::isnan(*info.null_value);  // NaN is null anyway
  // A source may be a file name in any bytes: what is not UTF-8 is replaced.
  const auto text = [](const json& j) { return j.dump(-1, ' ', false, json::error_handler_t::replace); };
  return {{"format", text(kFormatName)},
          {"version", text(kFormatVersion)},
          {"geometry", text(survey::geometry_to_json(info.geometry))},
          {"origin", text(info.origin)},
          {"role", text(name_of(info.role))},
          {"high_is_fault", text(info.high_is_fault)},
          {"null_value", text(has_null_value ? json(static_cast<double>(*info.null_value)) : json())},
          {"source", text(info.source)},
          {"provenance", info.provenance_json},
          {"statistics", text(statistics_json(info.statistics))},
          {"checksum", text(to_hex(info.checksum))}};
}

VolumeInfo info_from(const Description& description, const std::filesystem::path& path) {
  std::string name;
  const auto value = [&](const char* wanted) {
    name = wanted;
    return json::parse(description.at(wanted));
  };
  try {
    VolumeInfo info;
    if (value("format") != kFormatName) throw Error(ErrorCode::kFormat, "it names another format");
    const int version = value("version").get<int>();
    if (version > kFormatVersion) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{} has volume format {}; this program knows {}", path.string(), version,
                              kFormatVersion),
                  "open it with a newer Footwall");
    }
    if (version < 1) throw Error(ErrorCode::kFormat, fmt::format("there is no version {}", version));
    info.geometry = survey::geometry_from_json(value("geometry"));
    info.dims = info.geometry.dims();
    info.origin = value("origin").get<survey::Index>();
    info.role = role_from(value("role").get<std::string>());
    info.high_is_fault = value("high_is_fault").get<bool>();
    const json null_value = value("null_value");
    if (!null_value.is_null()) info.null_value = static_cast<float>(null_value.get<double>());
    info.source = value("source").get<std::string>();
    info.provenance_json = description.at("provenance");
    info.statistics = statistics_from(value("statistics"));
    info.checksum = hash_from_hex(value("checksum").get<std::string>());
    name = "provenance";
    if (!json::accept(info.provenance_json)) throw Error(ErrorCode::kFormat, "it is not JSON");
    return info;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kUnsupported) throw;
    throw Error(ErrorCode::kFormat,
                fmt::format("{}: attribute {}: {}", path.string(), name, error.message()));
  } catch (const std::exception& error) {  // JSON that does not parse or has other types, or a name not there
    throw Error(ErrorCode::kFormat, fmt::format("{}: attribute {}: {}", path.string(), name, error.what()));
  }
}

}  // namespace footwall::volume
