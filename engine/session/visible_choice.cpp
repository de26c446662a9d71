#include "engine/session/visible_choice.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "storage/base/error.h"

namespace footwall::session {

using Json = nlohmann::json;

std::filesystem::path VisibleChoice::pass_layer(int n) const {
  std::filesystem::path path = pass_layers;
  path += fmt::format("-{}", n);
  return path;
}

void VisibleChoice::apply_to(isosurface::VisibleRequest& request) const {
  request.mode = mode;
  request.budget_seconds = budget_seconds;
  request.passes = passes;
  request.cell = cell;
  request.estimate_cell = estimate_cell;
}

std::string_view name_of(isosurface::VisibleMode mode) {
  return mode == isosurface::VisibleMode::kPaper ? "paper" : "depth";
}

isosurface::VisibleMode visible_mode_from(std::string_view name) {
  for (const auto mode : {isosurface::VisibleMode::kDepth, isosurface::VisibleMode::kPaper}) {
    if (name == name_of(mode)) return mode;
  }
  throw Error(ErrorCode::kUsage, fmt::format("there is no mode '{}'", name), "choose one of: depth, paper");
}

Json json_of(const VisibleChoice& choice) {
  return {{"mode", name_of(choice.mode)},
          {"budget_seconds", choice.budget_seconds ? Json(*choice.budget_seconds) : Json()},
          {"passes", choice.passes},
          {"cell", choice.cell},
          {"estimate_cell", choice.estimate_cell},
          {"pass_layers", choice.pass_layers.string()}};
}

VisibleChoice visible_choice_from(const Json& json) {
  VisibleChoice choice;
  choice.mode = visible_mode_from(json.at("mode").get<std::string>());
  if (!json.at("budget_seconds").is_null()) choice.budget_seconds = json.at("budget_seconds").get<double>();
  choice.passes = json.at("passes").get<int>();
  choice.cell = json.at("cell").get<survey::Index>();
  choice.estimate_cell = json.at("estimate_cell").get<survey::Index>();
  choice.pass_layers = json.at("pass_layers").get<std::string>();
  return choice;
}

Json json_of(const isosurface::VisibleReport& report) {
  Json passes = Json::array();
  for (const isosurface::VisiblePass& pass : report.passes) {
    passes.push_back({{"cells", pass.cells},
                      {"triangles", pass.triangles},
                      {"load_difference", pass.load_difference},
                      {"uncovered_pixels", pass.uncovered_pixels},
                      {"percent", pass.percent},
                      {"seconds",
                       {{"visibility", pass.seconds.visibility},
                        {"partition", pass.seconds.partition},
                        {"assign", pass.seconds.assign},
                        {"extract", pass.seconds.extract},
                        {"composite", pass.seconds.composite}}}});
  }
  return {{"triangles", report.triangles},
          {"finished", report.finished},
          {"uncovered_pixels", report.passes.empty() ? 0 : report.passes.back().uncovered_pixels},
          {"passes", std::move(passes)}};
}

}  // namespace footwall::session
