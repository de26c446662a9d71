#include "app/footwall/commands/bench_quality.h"

#include <fmt/format.h>
#include <cmath>
#include <memory>

#include "app/footwall/commands/options.h"
#include "engine/tasks/bench_quality.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string size = "256x256x256", legs = "8,16,32";
  tasks::BenchQualityOptions how;
};

console::Json number(double value) {
  return std::isfinite(value) ? console::Json(value) : console::Json();
}

std::string percent(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f} %", 100 * value) : std::string("-");
}

console::Output run(Options& options, const console::Console& console) {
  options.how.size = dims_from(options.size, "--size");
  options.how.legs.clear();
  for (const std::string_view word : text::split(options.legs, ',')) {
    const auto leg = text::integer(word);
    if (!leg || *leg < 1 || *leg > 1000) {
      throw Error(ErrorCode::kUsage, fmt::format("--legs {} are no lengths", options.legs),
                  "give voxels, comma separated, such as 8,16,32");
    }
    options.how.legs.push_back(static_cast<int>(*leg));
  }
  const tasks::BenchQualityResult done = tasks::bench_quality(options.how, console.job());
  console::Output output;
  output.json = {{"size", options.how.size},
                 {"seed", options.how.seed},
                 {"volumes", options.how.volumes},
                 {"seconds", done.seconds},
                 {"legs", console::Json::array()}};
  output.text =
      "How often a true face scores higher than itself moved by 6 voxels; and how often offset finds "
      "the truth within 1 voxel\n";
  output.text += fmt::format("{:>4} {:>7} {:>7} {:>10} {:>15} {:>18} {:>10} {:>10}\n", "leg", "faces",
                             "pairs", "contrast", "discontinuity", "volume attribute", "variance", "offset");
  for (const tasks::QualityOfLeg& leg : done.legs) {
    output.json["legs"].push_back({{"leg", leg.leg},
                                   {"faces", leg.faces},
                                   {"pairs", leg.pairs},
                                   {"contrast", number(leg.chance.contrast)},
                                   {"discontinuity", number(leg.chance.discontinuity)},
                                   {"attribute", number(leg.chance.attribute)},
                                   {"variance", number(leg.chance.variance)},
                                   {"offsets", leg.offsets},
                                   {"offset_within_one", number(leg.within_one)}});
    output.text +=
        fmt::format("{:>4} {:>7} {:>7} {:>10} {:>15} {:>18} {:>10} {:>10}\n", leg.leg, leg.faces, leg.pairs,
                    percent(leg.chance.contrast), percent(leg.chance.discontinuity),
                    percent(leg.chance.attribute), percent(leg.chance.variance), percent(leg.within_one));
  }
  return output;
}

}  // namespace

void add_bench_quality(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "quality", "How well contrast and offset tell the faults of synthetic surveys",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("--size", options->size, "Voxels of each survey (default 256x256x256)");
  command->add_option("--seed", options->how.seed,
                      "Of the first survey; the others take the next (default 1)");
  command->add_option("--volumes", options->how.volumes, "Surveys (default 3)");
  command->add_option("--faces", options->how.faces, "Faces of each fault and leg in a survey (default 100)");
  command->add_option("--legs", options->legs, "Legs of the triangles in voxels (default 8,16,32)");
}

}  // namespace footwall::commands
