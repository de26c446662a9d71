#include "storage/survey/geometry_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "storage/base/error.h"

namespace footwall::survey {
namespace {

Geometry some_geometry() {
  Geometry g;
  g.inlines = {-100, 3, 40};
  g.crosslines = {2000, 1, 30};
  g.samples = 50;
  g.z0 = 0.1;
  g.interval = 1.0 / 3;
  g.domain = Domain::kDepth;
  g.vertical_unit = VerticalUnit::kFoot;
  g.map = {433417.181437539, 6786274.613921845, 1e-3, 25, 12.5, -7};
  g.crs = "ED50 / UTM 31N, \"Nørre\"";
  g.horizontal_unit = "ft";
  g.assumed = {"the unit", "the interval"};
  return g;
}

TEST(GeometryJson, ReadsBackAsItWasWritten) {
  for (const Geometry& g : {some_geometry(), Geometry()}) {
    const std::string text = geometry_to_json(g).dump();
    EXPECT_EQ(geometry_from_json(nlohmann::json::parse(text)), g);
  }
}

TEST(GeometryJson, WhatCannotBeIsRefused) {
  nlohmann::json json = geometry_to_json(some_geometry());
  json["interval"] = -1;
  EXPECT_THROW(geometry_from_json(json), Error);
  json = geometry_to_json(some_geometry());
  json["domain"] = "space";
  EXPECT_THROW(geometry_from_json(json), Error);
  json = geometry_to_json(some_geometry());
  json["map"].erase("origin_y");
  EXPECT_THROW(geometry_from_json(json), nlohmann::json::exception);
}

}  // namespace
}  // namespace footwall::survey
