// footwall export: volumes.
#include <fmt/format.h>

#include "app/footwall/commands/export_parts.h"
#include "engine/tasks/export_volume.h"

namespace footwall::commands {

void ExportVolumes::add_to(CLI::App& command) {
  command.add_option("--volume", volume, "The volume for --raw (default: the first)");
  command.add_option("--raw", raw, "Samples as float32 little-endian, [inline][crossline][sample]");
}

void ExportVolumes::run(const project::Project& project, const console::Console& console,
                        console::Output& output) const {
  const std::int64_t samples = tasks::export_raw(project, volume, raw, console.job());
  output.json["files"].push_back(raw);
  output.json["samples"] = samples;
  output.text += fmt::format("written {}: {} float32 samples, little-endian, [inline][crossline][sample]\n",
                             raw, samples);
}

}  // namespace footwall::commands
