#include "app/footwall/commands/bench_topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "engine/tasks/bench_topology.h"

namespace footwall::commands {
namespace {

constexpr std::size_t kMostPrinted = 20;  // mismatches in text; JSON has all

std::string text_of(const std::map<std::string, std::int64_t>& numbers) {
  std::string words;
  for (const auto& [name, number] : numbers)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", name, number);
  return words;
}

console::Output run(const tasks::BenchTopologyOptions& options, const console::Console& console) {
  const tasks::BenchTopologyResult done = tasks::bench_topology(options, console.job());
  console::Output output;
  output.json = {{"tables", options.tables},
                 {"rows", done.rows},
                 {"triangles", done.triangles},
                 {"open_edges", done.open_edges},
                 {"crowded_edges", done.crowded_edges},
                 {"mismatches", console::Json::array()},
                 {"cells", done.cells},
                 {"cells_undecided", done.cells_undecided},
                 {"cell_mismatches", done.cell_mismatches}};
  for (const tasks::TopologyMismatch& each : done.mismatches)
    output.json["mismatches"].push_back({{"id", each.id}, {"expected", each.expected}, {"got", each.got}});
  if (!options.csv.empty()) {
    output.text = fmt::format(
        "{} rows, {} triangles by the tables '{}': {} rows differ, {} open edges, {} edges with more than "
        "two "
        "triangles\n",
        done.rows, done.triangles, options.tables, done.mismatches.size(), done.open_edges,
        done.crowded_edges);
  }
  for (std::size_t n = 0; n < std::min(done.mismatches.size(), kMostPrinted); ++n) {
    const tasks::TopologyMismatch& each = done.mismatches[n];
    output.text +=
        fmt::format("row {}: expected {}, got {}\n", each.id, text_of(each.expected), text_of(each.got));
  }
  if (done.mismatches.size() > kMostPrinted)
    output.text += fmt::format("and {} more (--json has all)\n", done.mismatches.size() - kMostPrinted);
  if (done.cells > 0) {
    output.text += fmt::format(
        "{} random cells by the tables '{}': {} have another Euler number than the sampled trilinear field, "
        "in "
        "{} the level passes through a saddle\n",
        done.cells, options.tables, done.cell_mismatches, done.cells_undecided);
  }
  return output;
}

}  // namespace

void add_bench_topology(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<tasks::BenchTopologyOptions>();
  CLI::App* command =
      program.add(group, "topology", "Whether the case tables give the surfaces that trilinear fields have",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("--csv", options->csv,
                      "Rows of values and what is expected of their surfaces: id, v0..v7, chi; or id, b0, "
                      "genus, v0..v124");
  command->add_option("--cells", options->cells,
                      "Random cells to compare with the sampled trilinear field (default none)");
  command->add_option("--seed", options->seed, "Of the random cells (default 1)");
  command->add_option("--value", options->isovalue, "Isovalue (default 0)");
  command->add_option("--tables", options->tables,
                      "trilinear (default), or the rules of a seed: seed000, seed002");
}

}  // namespace footwall::commands
