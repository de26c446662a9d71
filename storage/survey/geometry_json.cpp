#include "storage/survey/geometry_json.h"

#include <nlohmann/json.hpp>

namespace footwall::survey {
namespace {

using nlohmann::json;

json axis_to_json(const LineAxis& axis) {
  return {{"first", axis.first}, {"step", axis.step}, {"count", axis.count}};
}

LineAxis axis_from_json(const json& j) {
  return {j.at("first").get<std::int32_t>(), j.at("step").get<std::int32_t>(),
          j.at("count").get<std::int64_t>()};
}

}  // namespace

json geometry_to_json(const Geometry& g) {
  return {{"inlines", axis_to_json(g.inlines)},
          {"crosslines", axis_to_json(g.crosslines)},
          {"samples", g.samples},
          {"z0", g.z0},
          {"interval", g.interval},
          {"domain", name_of(g.domain)},
          {"vertical_unit", name_of(g.vertical_unit)},
          {"map",
           {{"origin_x", g.map.origin_x},
            {"origin_y", g.map.origin_y},
            {"per_inline_x", g.map.per_inline_x},
            {"per_inline_y", g.map.per_inline_y},
            {"per_crossline_x", g.map.per_crossline_x},
            {"per_crossline_y", g.map.per_crossline_y}}},
          {"crs", g.crs},
          {"horizontal_unit", g.horizontal_unit},
          {"assumed", g.assumed}};
}

Geometry geometry_from_json(const json& j) {
  Geometry g;
  g.inlines = axis_from_json(j.at("inlines"));
  g.crosslines = axis_from_json(j.at("crosslines"));
  g.samples = j.at("samples").get<std::int64_t>();
  g.z0 = j.at("z0").get<double>();
  g.interval = j.at("interval").get<double>();
  g.domain = domain_from(j.at("domain").get<std::string>());
  g.vertical_unit = vertical_unit_from(j.at("vertical_unit").get<std::string>());
  const json& map = j.at("map");
  g.map = {map.at("origin_x").get<double>(),        map.at("origin_y").get<double>(),
           map.at("per_inline_x").get<double>(),    map.at("per_inline_y").get<double>(),
           map.at("per_crossline_x").get<double>(), map.at("per_crossline_y").get<double>()};
  g.crs = j.at("crs").get<std::string>();
  g.horizontal_unit = j.at("horizontal_unit").get<std::string>();
  g.assumed = j.at("assumed").get<std::vector<std::string>>();
  g.validate();
  return g;
}

}  // namespace footwall::survey
