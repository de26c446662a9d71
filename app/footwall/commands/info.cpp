// footwall info: what is in a project, a SEG-Y or an NRRD file, and whether it is whole.
#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/nrrd_info.h"
#include "app/footwall/commands/options.h"
#include "app/footwall/commands/segy_info.h"
#include "app/footwall/commands/segy_options.h"
#include "engine/tasks/project_facts.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string file;
  bool verify = false;
  SegyOptions segy;
};

std::string lines_text(const console::Json& lines) {
  return fmt::format("{} to {} by {} ({})", lines["first"].get<std::int64_t>(),
                     lines["last"].get<std::int64_t>(), lines["step"].get<std::int64_t>(),
                     lines["count"].get<std::int64_t>());
}

std::string survey_text(const console::Json& survey) {
  if (survey.is_null()) return "no survey yet\n";
  const auto unit = survey["vertical_unit"].get<std::string>();
  return fmt::format(
             "inlines    {}\ncrosslines {}\nsamples    {} from {} {} every {} {}, {}, z positive down\n",
             lines_text(survey["inlines"]), lines_text(survey["crosslines"]),
             survey["samples"].get<std::int64_t>(), survey["z0"].get<double>(), unit,
             survey["interval"].get<double>(), unit, survey["domain"].get<std::string>()) +
         fmt::format("CRS        {}\n",
                     survey["crs"].is_null() ? "not stated" : survey["crs"].get<std::string>());
}

std::string facts_text(const console::Json& facts) {
  std::string text = survey_text(facts["survey"]);
  for (const console::Json& volume : facts["volumes"]) {
    const auto value = [&](const char* key) {
      return volume[key].is_null() ? std::string("-") : fmt::format("{:.6g}", volume[key].get<double>());
    };
    text += fmt::format(
        "volume {}: {}x{}x{}, {} to {}, mean {}, standard deviation {}, {} nulls, {} live traces ({})\n",
        volume["name"].get<std::string>(), volume["dims"][0].get<std::int64_t>(),
        volume["dims"][1].get<std::int64_t>(), volume["dims"][2].get<std::int64_t>(), value("min"),
        value("max"), value("mean"), value("stddev"), volume["null_count"].get<std::int64_t>(),
        volume["live_traces"].get<std::int64_t>(), volume["source"].get<std::string>());
  }
  for (const console::Json& fault : facts["faults"]) {
    const std::string shape =
        fault["surface"].is_null()
            ? fmt::format("{} pillars, {} faces", fault["pillars"].get<std::int64_t>(),
                          fault["faces"].get<std::int64_t>())
            : fmt::format("surface, {} vertices, {} triangles", fault["vertices"].get<std::int64_t>(),
                          fault["faces"].get<std::int64_t>());
    text += fmt::format("fault {}: {}{}\n", fault["name"].get<std::string>(), shape,
                        fault["stale"].get<bool>() ? " (to be triangulated)" : "");
  }
  for (const console::Json& surface : facts["truth"]) {
    text += fmt::format("truth {}: {} faces\n", surface["name"].get<std::string>(),
                        surface["faces"].get<std::int64_t>());
  }
  for (const console::Json& run : facts["runs"]) {
    const std::string of =
        run["volume"].is_null() ? "set by hand" : "volume " + run["volume"].get<std::string>();
    text += fmt::format("run {}: {}, {}, {}\n", run["run"].get<std::int64_t>(),
                        run["name"].get<std::string>(), of, run["when"].get<std::string>());
  }
  for (const console::Json& file : facts["missing"]) {
    text += fmt::format("missing: volume {} ({}: {}); footwall relink mends it\n",
                        file["volume"].get<std::string>(), file["path"].get<std::string>(),
                        file["reason"].get<std::string>());
  }
  for (const console::Json& line : facts["assumed"]) text += "assumed: " + line.get<std::string>() + "\n";
  if (facts["verified"].get<bool>()) text += "every stored byte agrees with its checksum\n";
  return text;
}

// One that is too damaged to be recognised is reported as SEG-Y all the same, with the reason.
bool is_called_segy(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return ending == ".sgy" || ending == ".segy";
}

console::Output run(const Options& options, const console::Console& console) {
  if (formats::nrrd::looks_like_nrrd(options.file)) return nrrd_info(options.file);
  if (is_called_segy(options.file) || formats::segy::looks_like_segy(options.file)) {
    return segy_info(options.file, options.segy, console);
  }
  const project::Project project = open_project(options.file, project::OpenMode::kRead);
  console::Output output;
  output.json = tasks::project_facts(project, options.verify, console.job());
  output.text = facts_text(output.json);
  return output;
}

}  // namespace

void add_info(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(
      nullptr, "info", "Tell what is in a project, a SEG-Y or an NRRD file, and whether it is whole",
      [options](console::Console& console) { return run(*options, console); });
  command->add_option("file", options->file, "A project, a SEG-Y or an NRRD file")->required();
  command->add_flag("--verify", options->verify, "Read every volume whole and check every checksum");
  options->segy.add_to(*command);
}

}  // namespace footwall::commands
