// footwall extract: EXTRACT-ALL on the engine, the result attached to the project; or a forecast of it; or
// the job as a folder.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/options.h"
#include "engine/extract/registry.h"
#include "engine/tasks/extract_run.h"
#include "engine/tasks/forecast.h"
#include "engine/tasks/write_job.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, compute, job_folder, pillars;
  std::optional<double> memory_mib;
  bool dry_run = false;
  bool with_volume = false;
  EngineOptions engine;
  tasks::ExtractOptions how;
};

// "2x3": of a rank along inlines and along crosslines.
std::array<int, 2> pillars_from(const std::string& text) {
  const std::vector<std::string_view> parts = text::split(text, 'x');
  std::array<int, 2> pillars{};
  bool good = parts.size() == pillars.size();
  for (std::size_t axis = 0; good && axis < pillars.size(); ++axis) {
    const auto number = text::number(parts[axis]);
    good = number && *number >= 1 && *number <= 1024 && *number == std::floor(*number);
    if (good) pillars[axis] = static_cast<int>(*number);
  }
  if (!good) {
    throw Error(ErrorCode::kUsage, fmt::format("--pillars '{}' is not two numbers", text),
                "give those along inlines and along crosslines, from 1 to 1024, such as 2x2");
  }
  return pillars;
}

// An option that a computation alone looks at would change nothing without it.
void refuse_without(const extract::Options& engine, const char* option, const char* computation) {
  if (std::find(engine.compute.begin(), engine.compute.end(), computation) != engine.compute.end()) return;
  throw Error(ErrorCode::kUsage, fmt::format("{} is about --compute {}", option, computation),
              fmt::format("add {} to --compute", computation));
}

void check(Options& options) {
  options.how.launch = options.engine.launch();
  if (!options.pillars.empty()) options.how.engine.pillars = pillars_from(options.pillars);
  if (options.memory_mib) {
    constexpr double kMost = 1e9;
    constexpr double kMiB = 1 << 20;
    if (!(*options.memory_mib >= 0 && *options.memory_mib <= kMost)) {
      throw Error(ErrorCode::kUsage, fmt::format("--memory {} is no amount of memory", *options.memory_mib),
                  "give MiB, 0 to keep nothing");
    }
    options.how.engine.cache_bytes = static_cast<std::int64_t>(*options.memory_mib * kMiB);
  }
  const double snr = options.how.engine.snr;
  if (!(snr >= 0 && std::isfinite(snr))) {
    throw Error(ErrorCode::kUsage, fmt::format("--snr {} is no ratio", snr), "give decibels, such as 30");
  }
  if (options.how.velocity && !(*options.how.velocity > 0 && std::isfinite(*options.how.velocity))) {
    throw Error(ErrorCode::kUsage, fmt::format("--velocity {} is no velocity", *options.how.velocity),
                "give a number above 0, in m/s");
  }
  const extract::Options& engine = options.how.engine;
  if (engine.snr != 0) refuse_without(engine, "--snr", "lot");
  if (engine.lot_order != extract::Options{}.lot_order) refuse_without(engine, "--lot-order", "lot");
  if (engine.filter != extract::Options{}.filter) refuse_without(engine, "--filter", "filter");
  if (options.dry_run && !options.job_folder.empty()) {
    throw Error(ErrorCode::kUsage, "--dry-run changes nothing, so it cannot go with --write-job",
                "leave one of them out; --write-job prints the same forecast");
  }
  if (options.with_volume && options.job_folder.empty()) {
    throw Error(ErrorCode::kUsage, "--with-volume is about --write-job", "add --write-job FOLDER");
  }
}

// Seconds with two digits that mean something.
std::string seconds(double value) {
  return fmt::format("{:.{}f} s", value, value < 10 ? 1 : 0);
}

console::Json forecast_json(const tasks::Forecast& f) {
  return {{"command", f.command},
          {"launcher", f.launcher},
          {"ranks", f.ranks},
          {"threads", f.threads},
          {"faces", f.faces},
          {"voxels", f.voxels},
          {"voxels_counted", f.voxels_exact ? "exactly" : "estimated"},
          {"load_max_over_mean", f.load_max_over_mean},
          {"memory_per_rank",
           {{"program", f.memory.program},
            {"bricks", f.memory.bricks},
            {"reading", f.memory.reading},
            {"mesh", f.memory.mesh},
            {"exchange", f.memory.exchange},
            {"total", f.memory.total()}}},
          {"bytes_to_read", f.bytes_to_read},
          {"seconds",
           {{"start", f.seconds.start},
            {"read", f.seconds.read},
            {"compute", f.seconds.compute},
            {"write", f.seconds.write},
            {"total", f.seconds.total()}}},
          {"based_on", f.based_on}};
}

std::string forecast_in_words(const tasks::Forecast& f) {
  constexpr double kMega = 1e6;
  const auto mega = [](std::int64_t bytes) { return static_cast<double>(bytes) / kMega; };
  std::string text = fmt::format("{} faces, {} voxels ({}), on {} ranks of {} threads\n", f.faces, f.voxels,
                                 f.voxels_exact ? "counted" : "estimated", f.ranks, f.threads);
  text += fmt::format(
      "memory of a rank   {:.0f} MB: program {:.0f}, bricks {:.0f}, reading {:.0f}, mesh {:.1f}, exchange "
      "{:.1f}\n",
      mega(f.memory.total()), mega(f.memory.program), mega(f.memory.bricks), mega(f.memory.reading),
      mega(f.memory.mesh), mega(f.memory.exchange));
  text += fmt::format("to read            {:.0f} MB\n", mega(f.bytes_to_read));
  text += fmt::format("time               {}: start {}, read {}, compute {}, write {}\n",
                      seconds(f.seconds.total()), seconds(f.seconds.start), seconds(f.seconds.read),
                      seconds(f.seconds.compute), seconds(f.seconds.write));
  text += fmt::format("from               {}\n", f.based_on);
  return text;
}

tasks::Forecast forecast_of(const Options& options, const session::Job& job, const std::string& job_path,
                            int cores, const console::Console& console) {
  return tasks::forecast(job, options.how.launch, job_path, cores, console.job().part(0.1, 0.9));
}

console::Output dry_run(const Options& options, const console::Console& console) {
  project::Project project = open_project(options.project, project::OpenMode::kRead);
  const tasks::JobOfProject made = tasks::job_of_project(
      project, options.how, tasks::FreshMeshes::kThrownAway, console.job().part(0, 0.1));
  const tasks::Forecast forecast =
      forecast_of(options, made.job, "JOB.json", session::usable_cores(), console);
  console::Output output{forecast_json(forecast), forecast_in_words(forecast)};
  output.json["volume"] = made.job.volume_name;
  output.json["triangulated"] = made.triangulated;
  output.json["skipped"] = made.skipped;
  output.text += fmt::format("{}\n  {}\n", forecast.launcher, fmt::join(forecast.command, " "));
  return output;
}

console::Output write_job(const Options& options, const console::Console& console) {
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::JobOfProject made =
      tasks::job_of_project(project, options.how, tasks::FreshMeshes::kStored, console.job().part(0, 0.1));
  const tasks::Forecast forecast =
      forecast_of(options, made.job, options.job_folder + "/JOB.json", 0, console);
  tasks::write_job_folder(made.job, forecast, options.job_folder, options.with_volume,
                          console.job().part(0.9, 1));
  project.close();
  console::Output output{{{"job", options.job_folder + "/JOB.json"},
                          {"volume", made.job.volume_name},
                          {"with_volume", options.with_volume},
                          {"forecast", forecast_json(forecast)},
                          {"triangulated", made.triangulated},
                          {"skipped", made.skipped}},
                         forecast_in_words(forecast)};
  output.text += fmt::format("{} holds the job; its README.txt says how to run it\n", options.job_folder);
  return output;
}

console::Output run(Options& options, const console::Console& console) {
  for (const std::string_view name : text::split(options.compute, ',')) {
    if (!name.empty()) options.how.engine.compute.emplace_back(name);
  }
  check(options);
  if (options.dry_run) return dry_run(options, console);
  if (!options.job_folder.empty()) return write_job(options, console);
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::Extracted done = tasks::extract_run(project, options.how, console.job());
  project.close();

  const console::Json result = console::Json::parse(done.result_json);
  console::Output output;
  output.json = {{"run", done.run}, {"volume", done.volume}};
  add_result(result, output.json);
  output.json["triangulated"] = done.triangulated;
  output.json["skipped"] = done.skipped;
  output.text = fmt::format("run {}: {} of volume {}\n", done.run, result_in_words(result), done.volume);
  return output;
}

std::string names(std::span<const extract::Row> rows) {
  std::string text;
  for (const extract::Row& row : rows) {
    if (row.built) text += (text.empty() ? "" : ", ") + std::string(row.name);
  }
  return text;
}

}  // namespace

void add_extract(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "extract", "EXTRACT-ALL: statistics of the voxels that each face cuts",
                  [options](console::Console& console) { return run(*options, console); });
  tasks::ExtractOptions& how = options->how;
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--volume", how.volume, "The volume (default: the first)");
  command->add_option("--fault", how.fault, "Only this fault (default: all)");
  command->add_option("--name", how.name, "Name of the run (default: run N)");
  options->engine.add_to(*command, true);
  command->add_option(
      "--exchange", how.engine.exchange,
      "How values reach a face's rank: " + names(extract::exchange_rows()) + " (default auto)");
  command->add_option(
      "--balance", how.engine.balance,
      "How faces are spread over ranks: " + names(extract::balance_rows()) + " (default auto)");
  command->add_option("--voxelizer", how.engine.voxelizer,
                      "Which voxels a face cuts: " + names(extract::voxelizer_rows()) + " (default exact)");
  command->add_option(
      "--compute", options->compute,
      "Statistics, comma separated: " + names(extract::statistic_rows()) + " (default: count to contrast)");
  command->add_option("--filter", how.engine.filter,
                      "Of --compute filter: band=SHORT,LONG or sharpen=AMOUNT,LENGTH, wavelengths in voxels "
                      "(default band=4,32)");
  command->add_option("--pillars", options->pillars,
                      "AxB: cut each rank's part into A x B pillars that lie between those of others, which "
                      "evens out crowded surveys (default 1x1)");
  command->add_option("--memory", options->memory_mib,
                      "MiB of other ranks' voxels that a rank keeps, where voxels move (default 1024)");
  command->add_option(
      "--snr", how.engine.snr,
      "dB, for --compute lot: keeps the voxels, within this signal-to-noise ratio (1 to 100)");
  command->add_option(
      "--lot-order", how.engine.lot_order,
      "For --compute lot: 2d, the face as a picture, or 1d, as a line; =tuned: for band-limited "
      "traces; 1d=zero: with zeros at the ends (default 2d)");
  command->add_option("--velocity", how.velocity,
                      "m/s: gives area and dip in metres and degrees in a time survey");
  command->add_flag("--dry-run", options->dry_run,
                    "Only tell what it would need: memory, bytes to read, seconds; changes nothing");
  command->add_option(
      "--write-job", options->job_folder,
      "Only write the job into this folder, to be run elsewhere (footwall attach brings it back)");
  command->add_flag("--with-volume", options->with_volume, "With --write-job: put the volume there too");
}

}  // namespace footwall::commands
