#include <fmt/format.h>

#include <cstdlib>

#include "app/footwall/commands/bench_visible.h"

namespace footwall::commands {
namespace {

using console::Json;

constexpr double kMilli = 1e3;
constexpr const char* kPhases[] = {"visibility", "partition", "assign", "extract", "composite"};

std::string cell_in_words(const Json& cell) {
  const auto n = cell.get<std::array<std::int64_t, 3>>();
  return n[0] == n[1] && n[1] == n[2] ? fmt::format("{}", n[0]) : fmt::format("{}x{}x{}", n[0], n[1], n[2]);
}

// The rows of a view, one for each cell in which work is estimated.
std::vector<Json> rows_of(const Json& run, std::size_t view) {
  std::vector<Json> rows;
  for (const Json& row : run.at("rows")) {
    if (row.at("view").get<std::size_t>() == view) rows.push_back(row);
  }
  return rows;
}

// Of a run; processor time where it is told.
double seconds_of(const Json& row) {
  const Json& busy = row.at("busy_seconds");
  return (busy.is_null() ? row.at("median_seconds") : busy).get<double>();
}

std::string estimate_of(const Json& row) {
  const std::string words = cell_in_words(row.at("estimate_cell"));
  return words == "0" ? "counted" : "cell " + words;
}

// In `extract` processor time where it is told.
double seconds_of(const Json& pass, const std::string& phase) {
  const Json& busy = pass.at("busy_seconds");
  return (phase == "extract" && !busy.is_null() ? busy : pass.at("seconds")).at(phase).get<double>();
}

double share(double of, double all) {
  return all > 0 ? 100 * of / all : 0;
}

std::string sizes(const Json& run) {
  std::string text = "table 1: triangles of the visible part and of the whole\n";
  text += fmt::format("{:>14} {:>12} {:>8} {:>12} {:>12} {:>7} {:>12} {:>12}\n", "view", "visible", "",
                      "whole", "own a pixel", "passes", "px farther", "px lost");
  for (std::size_t view = 0; view < run.at("whole").size(); ++view) {
    const Json& whole = run.at("whole")[view];
    const Json row = rows_of(run, view).front();
    const auto angles = run.at("views")[view].get<std::array<double, 2>>();
    const auto triangles = row.at("triangles").get<std::int64_t>();
    const auto all = whole.at("triangles").get<std::int64_t>();
    text +=
        fmt::format("{:>14} {:>12} {:>7.1f}% {:>12} {:>12} {:>7} {:>12} {:>12}\n",
                    fmt::format("{:g},{:g}", angles[0], angles[1]), triangles,
                    share(static_cast<double>(triangles), static_cast<double>(all)), all,
                    whole.at("triangles_seen").get<std::int64_t>(), row.at("passes").size(),
                    row.at("pixels_farther").get<std::int64_t>(), row.at("pixels_lost").get<std::int64_t>());
  }
  return text;
}

std::string times(const Json& runs, std::size_t view) {
  const Json& first = runs.front();
  const Json& whole = first.at("whole")[view];
  const double extraction = whole.at("extract_seconds").get<double>();
  std::string text = fmt::format(
      "\ntables 2 and 3, figures 7 and 8: view {}, ms; by the cells in which work is estimated\n{:>6}",
      view + 1, "ranks");
  for (const Json& row : rows_of(first, view)) {
    text += fmt::format(" {:>9} {:>9} {:>8} {:>6}", estimate_of(row), "own cores", "speed-up", "eff.");
  }
  text += fmt::format(" {:>12}\n", "whole/ranks");
  for (const Json& run : runs) {
    const int ranks = run.at("ranks").get<int>();
    text += fmt::format("{:>6}", ranks);
    const std::vector<Json> rows = rows_of(run, view);
    const std::vector<Json> rows_of_first = rows_of(first, view);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const double busy = seconds_of(rows[n]);
      const double gain = busy > 0 ? seconds_of(rows_of_first[n]) / busy : 1;
      text += fmt::format(" {:>9.2f} {:>9.2f} {:>8.2f} {:>6.2f}",
                          kMilli * rows[n].at("median_seconds").get<double>(), kMilli * busy, gain,
                          gain * first.at("ranks").get<int>() / ranks);
    }
    text += fmt::format(" {:>12.2f}\n", kMilli * extraction / ranks);
  }
  text += fmt::format(
      "whole: extracted in {:.2f} ms and drawn in {:.2f} ms by one rank; divided by ranks as if nothing were "
      "lost\n"
      "own cores: processor time of rank 0's decisions and of the slowest rank's triangles, messages left "
      "out\n"
      "(in mode depth the time as it was); speed-up and efficiency are of that\n",
      kMilli * extraction, kMilli * whole.at("draw_seconds").get<double>());
  return text;
}

std::string phases(const Json& runs, std::size_t view) {
  std::string text = fmt::format(
      "\nfigure 9: where the time goes, view {}, ms (extract of mode paper: processor time)\n{:>6}", view + 1,
      "ranks");
  for (const char* phase : kPhases) text += fmt::format(" {:>10}", phase);
  text += "\n";
  for (const Json& run : runs) {
    text += fmt::format("{:>6}", run.at("ranks").get<int>());
    const Json row = rows_of(run, view).back();
    for (const std::string phase : kPhases) {
      double seconds = 0;
      for (const Json& pass : row.at("passes")) seconds += seconds_of(pass, phase);
      text += fmt::format(" {:>10.2f}", kMilli * seconds);
    }
    text += "\n";
  }
  return text;
}

std::string loads(const Json& runs) {
  std::string text = fmt::format("\ntable 4: load difference\n{:>6}", "ranks");
  const std::size_t views = runs.front().at("views").size();
  for (std::size_t view = 0; view < views; ++view)
    text += fmt::format(" {:>8}", fmt::format("view {}", view + 1));
  text += "\n";
  for (const Json& run : runs) {
    if (run.at("ranks").get<int>() < 2) continue;
    text += fmt::format("{:>6}", run.at("ranks").get<int>());
    for (std::size_t view = 0; view < views; ++view)
      text += fmt::format(" {:>7.2f}%", 100 * rows_of(run, view).back().at("load_difference").get<double>());
    text += "\n";
  }
  return text;
}

std::string passes(const Json& runs, std::size_t view) {
  // Of four ranks, as the paper's, or what is nearest to that.
  const Json* run = &runs.front();
  for (const Json& each : runs) {
    if (std::abs(each.at("ranks").get<int>() - 4) < std::abs(run->at("ranks").get<int>() - 4)) run = &each;
  }
  const Json row = rows_of(*run, view).back();
  std::string text = fmt::format("\ntables 5 and 6, figures 10 and 11: view {}, {} ranks\n", view + 1,
                                 run->at("ranks").get<int>());
  text += fmt::format("{:>6} {:>8} {:>12} {:>11} {:>9} {:>12}\n", "pass", "cells", "triangles", "difference",
                      "so far", "uncovered");
  std::int64_t cells = 0;
  int number = 0;
  for (const Json& pass : row.at("passes")) {
    cells += pass.at("cells").get<std::int64_t>();
    text += fmt::format("{:>6} {:>8} {:>12} {:>10.2f}% {:>8.2f}% {:>12}\n", ++number,
                        pass.at("cells").get<std::int64_t>(), pass.at("triangles").get<std::int64_t>(),
                        100 * pass.at("load_difference").get<double>(), pass.at("percent").get<double>(),
                        pass.at("uncovered_pixels").get<std::int64_t>());
  }
  text += fmt::format("{:>6} {:>8} {:>12} {:>10.2f}%\n", "all", cells,
                      row.at("triangles").get<std::int64_t>(), 100 * row.at("load_difference").get<double>());
  return text;
}

std::string of_mode(const std::string& volume, const Json& runs) {
  const Json& first = runs.front();
  const auto size = first.at("size").get<std::array<std::int64_t, 3>>();
  std::string text = fmt::format("{} {}x{}x{} at {:g}, {}x{} pixels, cells of {}, mode {}\n\n", volume,
                                 size[2], size[1], size[0], first.at("value").get<double>(),
                                 first.at("width").get<int>(), first.at("height").get<int>(),
                                 cell_in_words(first.at("cell")), first.at("mode").get<std::string>());
  text += sizes(first);
  const std::size_t views = first.at("views").size();
  for (std::size_t view = 0; view < views; ++view) text += times(runs, view);
  for (std::size_t view = 0; view < views; ++view) text += phases(runs, view);
  text += loads(runs);
  for (std::size_t view = 0; view < views; ++view) text += passes(runs, view);
  return text + "\n";
}

}  // namespace

std::string visible_tables(const console::Json& result) {
  std::string text;
  const auto volume = result.at("volume").get<std::string>();
  Json of_one_mode = Json::array();
  for (const Json& run : result.at("runs")) {
    if (!of_one_mode.empty() && of_one_mode.front().at("mode") != run.at("mode")) {
      text += of_mode(volume, of_one_mode);
      of_one_mode = Json::array();
    }
    of_one_mode.push_back(run);
  }
  text += of_mode(volume, of_one_mode);
  return text +
         "px farther: show something behind what is seen of the whole surface; px lost: show nothing of it\n"
         "every number of ranks found the same cells and triangles in each pass";
}

}  // namespace footwall::commands
