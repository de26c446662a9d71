// footwall faces: per-face statistics of a run, as CSV or ranked.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/extract/face.h"
#include "engine/tasks/face_tables.h"
#include "engine/tasks/set_statistic.h"
#include "storage/base/log.h"
#include "storage/formats/face_arrays.h"
#include "storage/formats/faces_csv.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, fault, csv, arrays, coordinates = "world", lowest, highest;
  std::optional<std::int64_t> run;
  std::size_t top = 10;
  bool present = false;
};

console::Json ranked_json(const tasks::FaceTables& faces, const std::vector<tasks::RankedFace>& ranked) {
  console::Json rows = console::Json::array();
  for (const tasks::RankedFace& one : ranked) {
    const formats::MeshTable& table = faces.tables[one.table];
    console::Json row = {{"fault", table.fault}, {"face", table.face_ids[one.face]}};
    for (const formats::FaceStatistic& statistic : table.statistics)
      row[statistic.name] = statistic.values[one.face];
    rows.push_back(std::move(row));
  }
  return rows;
}

// Contrast where the run has it; runs of earlier versions, or of other statistics, do not.
std::string default_ranking(const tasks::FaceTables& faces) {
  for (const formats::MeshTable& table : faces.tables) {
    const std::vector<double>* contrast = nullptr;
    for (const formats::FaceStatistic& statistic : table.statistics)
      if (statistic.name == "contrast") contrast = &statistic.values;
    if (contrast != nullptr &&
        std::any_of(contrast->begin(), contrast->end(), [](double v) { return !std::isnan(v); }))
      return "contrast";
  }
  const std::string by_hand = tasks::statistic_set_by_hand(*faces.run);
  return by_hand.empty() ? "discontinuity" : by_hand;
}

console::Json arrays_json(const std::string& file, const std::vector<formats::MeshTable>& tables) {
  console::Json faults = console::Json::array();
  for (const formats::MeshTable& table : tables) faults.push_back(table.fault);
  console::Json layout = console::Json::array();
  for (const formats::face_arrays::Array& array : formats::face_arrays::write(file, tables)) {
    layout.push_back(
        {{"name", array.name}, {"type", array.type}, {"shape", array.shape}, {"offset", array.offset}});
  }
  return {{"file", file}, {"faults", faults}, {"layout", layout}};
}

// The statistics over the distinct voxels of the faults; of runs that have them.
console::Json fault_rows(const tasks::FaceTables& faces, const std::string& fault) {
  console::Json rows = console::Json::array();
  const console::Json result = console::Json::parse(faces.run->result, nullptr, false);
  if (!result.is_object() || !result.contains("faults")) return rows;
  for (const console::Json& row : result["faults"]) {
    if (fault.empty() || row.value("name", "") == fault) rows.push_back(row);
  }
  return rows;
}

std::string faults_text(const console::Json& rows) {
  std::string text;
  for (const console::Json& row : rows) {
    const auto value = [&](const char* key) {
      return row[key].is_null() ? std::string("-") : fmt::format("{:.5g}", row[key].get<double>());
    };
    text += fmt::format("{}: {} distinct voxels, mean {}, variance {}, {} to {}, discontinuity {}\n",
                        row["name"].get<std::string>(),
                        row["count"].get<std::int64_t>() + row["nulls"].get<std::int64_t>(), value("mean"),
                        value("variance"), value("min"), value("max"), value("discontinuity"));
  }
  return text;
}

// What the faces were ranked by comes first.
std::string ranked_text(const tasks::FaceTables& faces, const std::vector<tasks::RankedFace>& ranked,
                        const std::string& ranked_by) {
  std::vector<std::string> columns{"contrast", "discontinuity", "variance", "count", "dip"};
  if (std::find(columns.begin(), columns.end(), ranked_by) == columns.end())
    columns.insert(columns.begin(), ranked_by);
  std::string text = fmt::format("{:<16} {:<24}", "fault", "face");
  for (const std::string& column : columns) text += fmt::format(" {:>13}", column);
  text += "\n";
  for (const tasks::RankedFace& one : ranked) {
    const formats::MeshTable& table = faces.tables[one.table];
    text += fmt::format("{:<16} {:<24}", table.fault, table.face_ids[one.face]);
    for (const std::string& column : columns) {
      const auto known = std::find_if(table.statistics.begin(), table.statistics.end(),
                                      [&](const auto& statistic) { return statistic.name == column; });
      const double value = known == table.statistics.end() ? extract::kUndefined : known->values[one.face];
      text += std::isnan(value) ? fmt::format(" {:>13}", "-") : fmt::format(" {:>13.5g}", value);
    }
    text += "\n";
  }
  return text;
}

void write_files(const std::vector<formats::MeshTable>& tables, const Options& options,
                 console::Output& output) {
  if (!options.csv.empty()) {
    formats::faces_csv::write(options.csv, tables);
    output.json["csv"] = options.csv;
    output.text += "written to " + options.csv + "\n";
  }
  if (!options.arrays.empty()) {
    output.json["arrays"] = arrays_json(options.arrays, tables);
    output.text += "written to " + options.arrays + "\n";
  }
}

// The meshes as they are now, with no run.
console::Output present(const project::Project& project, const Options& options,
                        tasks::Coordinates coordinates) {
  if (options.run || !options.lowest.empty() || !options.highest.empty())
    throw Error(ErrorCode::kUsage, "--present has no statistics", "leave --run, --lowest and --highest out");
  const tasks::FaceTables faces = tasks::present_faces(project, options.fault, coordinates);
  for (const std::string& name : faces.stale) log::warn(name + " was edited since its mesh was made");
  std::size_t count = 0;
  for (const formats::MeshTable& table : faces.tables) count += table.triangles.size();
  console::Output output;
  output.json = {{"run", nullptr}, {"volume", nullptr}, {"count", count}, {"stale", faces.stale}};
  output.text = fmt::format("{} faces\n", count);
  write_files(faces.tables, options, output);
  return output;
}

console::Output run(const Options& options) {
  const project::Project project = open_project(options.project, project::OpenMode::kRead);
  const auto coordinates =
      options.coordinates == "index" ? tasks::Coordinates::kIndex : tasks::Coordinates::kWorld;
  if (options.present) return present(project, options, coordinates);
  const bool lowest = !options.lowest.empty() || options.highest.empty();
  const std::string& asked = lowest ? options.lowest : options.highest;
  const auto chosen = tasks::chosen_run(project, options.run, asked);
  if (!chosen) throw Error(ErrorCode::kNotFound, "the project has no run yet", "footwall extract makes one");
  const tasks::FaceTables faces = tasks::face_tables(project, options.fault, chosen->id, coordinates);
  for (const std::string& name : faces.stale) log::warn(name + " was edited since this run");
  std::size_t count = 0;
  for (const formats::MeshTable& table : faces.tables) count += table.triangles.size();

  console::Output output;
  output.json = {{"run", faces.run->id},
                 {"volume", faces.run->volume.empty() ? console::Json() : console::Json(faces.run->volume)},
                 {"count", count},
                 {"stale", faces.stale}};
  output.json["faults"] = fault_rows(faces, options.fault);
  const std::string of = faces.run->volume.empty() ? ", set by hand" : " of volume " + faces.run->volume;
  output.text = fmt::format("run {}: {} faces{}\n", faces.run->id, count, of);
  output.text += faults_text(output.json["faults"]);
  write_files(faces.tables, options, output);
  std::string statistic = asked;
  if (statistic.empty() && options.csv.empty() && options.arrays.empty()) statistic = default_ranking(faces);
  if (!statistic.empty()) {
    const auto ranked = tasks::ranked_faces(faces, statistic, lowest, options.top);
    output.json["faces"] = ranked_json(faces, ranked);
    if (ranked.empty()) {
      output.text += fmt::format(
          "no face of at least 30 samples has a value of {0}: too small, not computed in this run (extract "
          "--compute {0}), or without --velocity in a time survey\n",
          statistic);
      return output;
    }
    output.text += fmt::format("the {} faces of {} {} (of those with at least 30 samples)\n", ranked.size(),
                               lowest ? "lowest" : "highest", statistic);
    output.text += ranked_text(faces, ranked, statistic);
  }
  return output;
}

}  // namespace

void add_faces(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(nullptr, "faces", "Per-face statistics of a run",
                                  [options](console::Console&) { return run(*options); });
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--fault", options->fault, "Only this fault (default: all)");
  command->add_option("--run", options->run, "The run's number (default: the last)");
  command->add_option("--csv", options->csv, "Write all faces to this file");
  command->add_option("--arrays", options->arrays,
                      "Write all faces to this file as plain arrays, which --json describes");
  command->add_flag("--present", options->present, "The present meshes, without statistics");
  command
      ->add_option("--coordinates", options->coordinates,
                   "world: as picked; index: the rounded positions that were computed on, in voxels")
      ->check(CLI::IsMember({"world", "index"}));
  command->add_option("--lowest", options->lowest, "List the faces with the lowest values of this statistic");
  command
      ->add_option("--highest", options->highest, "List the faces with the highest values of this statistic")
      ->excludes("--lowest");
  command->add_option("--top", options->top, "How many of them (default 10)")->check(CLI::NonNegativeNumber);
}

}  // namespace footwall::commands
