// footwall new: a project, with a first volume where asked.
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/tasks/new_project.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, segy, raw, synthetic, size = "256x256x256", name;
  std::uint64_t seed = 1;
  double signal_to_noise = 4;
  VolumeOptions volume;
};

std::string volume_name(const Options& options, const std::string& file) {
  return options.name.empty() ? std::filesystem::path(file).stem().string() : options.name;
}

console::Output run(const Options& options, const console::Console& console) {
  const int sources = !options.segy.empty() + !options.raw.empty() + !options.synthetic.empty();
  if (sources > 1) {
    throw Error(ErrorCode::kUsage, "--segy, --raw and --synthetic exclude each other",
                "give one; footwall import volume adds more");
  }
  project::VolumeRecord volume;
  std::vector<std::string> warnings;
  if (!options.segy.empty()) {
    const tasks::SegyImport import =
        tasks::segy_source(options.segy, options.volume.segy(), console.job().part(0, 0.4));
    warnings = import.report.warnings;
    volume = tasks::new_project(options.project, volume_name(options, options.segy), import.source,
                                console.job().part(0.4, 1));
  } else if (!options.raw.empty()) {
    const tasks::VolumeSource source =
        tasks::raw_source(options.raw, options.volume.raw(), options.volume.raw_geometry());
    volume = tasks::new_project(options.project, volume_name(options, options.raw), source, console.job());
  } else if (!options.synthetic.empty()) {
    volume =
        tasks::new_synthetic_project(options.project, options.synthetic, dims_from(options.size, "--size"),
                                     options.seed, options.signal_to_noise, console.job());
  } else {
    tasks::new_empty_project(options.project);
    return {{{"project", options.project}}, "made " + options.project + ", without a survey yet"};
  }
  for (const std::string& warning : warnings) log::warn(warning);
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  console::Output output = volume_output(volume, project.survey().value());
  output.json["project"] = options.project;
  output.json["faults"] = project.faults().size();
  output.json["warnings"] = warnings;
  output.text = "made " + options.project + "\n" + output.text;
  return output;
}

}  // namespace

void add_new(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "new", "Make a project, with a first volume if asked",
                                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("project", options->project, "The project file to make, NAME.footwall")->required();
  command->add_option("--segy", options->segy, "Import this SEG-Y file (needs --domain and --vertical-unit)");
  command->add_option("--raw", options->raw,
                      "Import this raw float32 file (needs --dims, --domain, --vertical-unit, --interval)");
  command->add_option("--synthetic", options->synthetic, "Make a survey with known faults: faulted");
  command->add_option("--size", options->size,
                      "Synthetic: inlines x crosslines x samples (default 256x256x256)");
  command
      ->add_option("--seed", options->seed,
                   "Synthetic: the same seed gives the same bytes on every machine (default 1)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--signal-to-noise", options->signal_to_noise,
                      "Synthetic: ratio of rms amplitudes (default 4)");
  command->add_option("--name", options->name, "Name of the volume (default: the file's name)");
  options->volume.add_to(*command);
}

}  // namespace footwall::commands
