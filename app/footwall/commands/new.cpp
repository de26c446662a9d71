// footwall new: a project, with a first volume where asked.
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/volume_input.h"
#include "engine/tasks/new_project.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, segy, nrrd, raw, synthetic, size = "256x256x256", name;
  std::uint64_t seed = 1;
  double signal_to_noise = 4;
  VolumeOptions volume;
  ShapeOptions shape;
};

// The file that the first volume comes from; empty where there is none.
std::pair<std::string, VolumeKind> file_of(const Options& options) {
  if (!options.segy.empty()) return {options.segy, VolumeKind::kSegy};
  if (!options.nrrd.empty()) return {options.nrrd, VolumeKind::kNrrd};
  return {options.raw, VolumeKind::kRaw};
}

console::Output run(const Options& options, const console::Console& console) {
  const int sources =
      !options.segy.empty() + !options.nrrd.empty() + !options.raw.empty() + !options.synthetic.empty();
  if (sources > 1) {
    throw Error(ErrorCode::kUsage, "--segy, --nrrd, --raw and --synthetic exclude each other",
                "give one; footwall import volume adds more");
  }
  const auto [file, kind] = file_of(options);
  project::VolumeRecord volume;
  VolumeInput input;
  if (!file.empty()) {
    const double headers = share_of_headers(kind);
    input =
        volume_input(file, kind, options.volume, options.shape, std::nullopt,
                     std::filesystem::path(options.project).parent_path(), console.job().part(0, headers));
    const std::string name =
        options.name.empty() ? std::filesystem::path(file).stem().string() : options.name;
    volume = tasks::new_project(options.project, name, input.source, console.job().part(headers, 1));
  } else if (!options.synthetic.empty()) {
    if (options.shape.given()) {
      throw Error(ErrorCode::kUsage, "--inlines, --crosslines, --z and --resample go with a file",
                  "--size chooses how large a synthetic survey is");
    }
    volume =
        tasks::new_synthetic_project(options.project, options.synthetic, dims_from(options.size, "--size"),
                                     options.seed, options.signal_to_noise, console.job());
  } else {
    tasks::new_empty_project(options.project);
    return {{{"project", options.project}}, "made " + options.project + ", without a survey yet"};
  }
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  input.report.assumed = project.survey().value().assumed;
  console::Output output = volume_output(volume, input);
  output.json["project"] = options.project;
  output.json["faults"] = project.faults().size();
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
  command->add_option("--nrrd", options->nrrd, "Import this NRRD file (.nrrd or .nhdr)");
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
  options->shape.add_to(*command);
}

}  // namespace footwall::commands
