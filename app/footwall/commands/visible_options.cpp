#include "app/footwall/commands/visible_options.h"

#include <fmt/format.h>

#include <cmath>

#include "app/footwall/commands/options.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

// "8", or "8x8x16".
survey::Index cell_from(const std::string& text, const std::string& option) {
  if (text.empty()) return {0, 0, 0};
  constexpr std::int64_t kMost = std::int64_t{1} << 20;
  survey::Index cell{};
  if (const auto edge = text::integer(text)) {
    cell = {*edge, *edge, *edge};
  } else {
    cell = dims_from(text, option);
  }
  for (const std::int64_t edge : cell) {
    if (edge < 1 || edge > kMost) {
      throw Error(ErrorCode::kUsage, fmt::format("{} {} is no size of a cell", option, text),
                  fmt::format("give the samples along its edges, 1 to {}, as 8 or 8x8x16", kMost));
    }
  }
  return cell;
}

}  // namespace

void VisibleOptions::add_to(CLI::App& command) {
  command.add_flag("--visible", visible, "Extract only what can be seen from the camera");
  command.add_option(
      "--mode", mode,
      "How it is found: depth (default; the picture is that of the whole), or paper (as it was "
      "published: it can lose what is seen)");
  command.add_option("--budget", budget,
                     "Milliseconds; the pass in which they are over is the last (default: to the end)");
  command.add_option("--passes", passes, "At most so many passes (default: to the end)");
  command.add_option(
      "--cell", cell,
      "Mode paper: cells of its octree, N or NxMxK samples (default: about 32 along each axis)");
  command.add_option("--estimate-cell", estimate_cell,
                     "Mode paper: cells in which work is estimated, N or NxMxK samples (default 1)");
  command.add_option("--pass-images", pass_images,
                     "Also write a PNG after each pass into this folder: pass-001.png, ...");
}

std::string VisibleOptions::needs_visible() const {
  if (!mode.empty()) return "--mode";
  if (budget) return "--budget";
  if (passes) return "--passes";
  if (!cell.empty()) return "--cell";
  if (!estimate_cell.empty()) return "--estimate-cell";
  if (!pass_images.empty()) return "--pass-images";
  return "";
}

std::optional<session::VisibleChoice> VisibleOptions::choice() const {
  if (!visible) {
    if (const std::string option = needs_visible(); !option.empty()) {
      throw Error(ErrorCode::kUsage, option + " is of use only where what can be seen is extracted",
                  "add --visible, or leave it out");
    }
    return std::nullopt;
  }
  session::VisibleChoice choice;
  if (!mode.empty()) choice.mode = session::visible_mode_from(mode);
  if (budget) {
    if (!(*budget > 0) || !std::isfinite(*budget)) {
      throw Error(ErrorCode::kUsage, fmt::format("--budget {} is no time", *budget),
                  "give milliseconds above 0, or leave it out: passes go on to the end");
    }
    choice.budget_seconds = *budget / 1000;
  }
  if (passes) {
    if (*passes < 1) {
      throw Error(ErrorCode::kUsage, fmt::format("{} passes cannot be made", *passes),
                  "give --passes 1 or more, or leave it out: passes go on to the end");
    }
    choice.passes = *passes;
  }
  if (choice.mode != isosurface::VisibleMode::kPaper && (!cell.empty() || !estimate_cell.empty())) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} is of mode paper", cell.empty() ? "--estimate-cell" : "--cell"),
                "add --mode paper, or leave it out");
  }
  choice.cell = cell_from(cell, "--cell");
  choice.estimate_cell = cell_from(estimate_cell, "--estimate-cell");
  return choice;
}

std::string passes_in_words(const console::Json& report) {
  std::string text = fmt::format("{:>4} {:>8} {:>10} {:>9} {:>10} {:>7} {:>9}", "pass", "cells", "triangles",
                                 "load diff", "uncovered", "so far", "ms");
  int n = 0;
  for (const console::Json& pass : report.at("passes")) {
    double seconds = 0;
    for (const auto& [phase, spent] : pass.at("seconds").items()) seconds += spent.get<double>();
    text += fmt::format("\n{:>4} {:>8} {:>10} {:>7.1f} % {:>10} {:>5.1f} % {:>9.2f}", ++n,
                        pass.at("cells").get<std::int64_t>(), pass.at("triangles").get<std::int64_t>(),
                        100 * pass.at("load_difference").get<double>(),
                        pass.at("uncovered_pixels").get<std::int64_t>(), pass.at("percent").get<double>(),
                        1000 * seconds);
  }
  return text;
}

}  // namespace footwall::commands
