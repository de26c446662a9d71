// How only what can be seen of isosurfaces is to be found, and what was found, in the engine's job and result
// files.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "engine/isosurface/visible/passes.h"

namespace footwall::session {

// Words of isosurface::VisibleRequest that users choose. On disk: {mode ("depth", "paper"), budget_seconds
// (or null), passes, cell[3], estimate_cell[3], pass_layers}.
struct VisibleChoice {
  isosurface::VisibleMode mode = isosurface::VisibleMode::kDepth;
  std::optional<double> budget_seconds;
  int passes = 0;
  survey::Index cell{0, 0, 0};
  survey::Index estimate_cell{0, 0, 0};
  // The picture after pass n of all isosurfaces, counted from 1, goes to the file pass_layer(n); empty: none
  // is kept.
  std::filesystem::path pass_layers;

  std::filesystem::path pass_layer(int n) const;
  void apply_to(isosurface::VisibleRequest& request) const;
};

std::string_view name_of(isosurface::VisibleMode mode);
// Throws Error kUsage naming the modes there are.
isosurface::VisibleMode visible_mode_from(std::string_view name);

nlohmann::json json_of(const VisibleChoice& choice);
// Lets the JSON library's exceptions through.
VisibleChoice visible_choice_from(const nlohmann::json& json);

// {triangles, finished, uncovered_pixels, passes: [{cells, triangles, load_difference, uncovered_pixels,
// percent, seconds: {visibility, partition, assign, extract, composite}}]}; uncovered_pixels of the request's
// picture.
nlohmann::json json_of(const isosurface::VisibleReport& report);

}  // namespace footwall::session
