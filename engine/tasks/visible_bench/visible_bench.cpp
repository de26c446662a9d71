#include "engine/tasks/visible_bench/visible_bench.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/session/job_json.h"
#include "engine/session/private_folder.h"

namespace footwall::tasks {
namespace {

using Json = nlohmann::ordered_json;

// What must not depend on the number of ranks.
Json common_of(const Json& run) {
  Json common = Json::array();
  for (const Json& row : run.at("rows")) {
    for (const Json& pass : row.at("passes"))
      common.push_back({pass.at("cells"), pass.at("triangles"), pass.at("uncovered_pixels")});
    common.push_back(
        {row.at("triangles"), row.at("pixels"), row.at("pixels_farther"), row.at("pixels_lost")});
  }
  return common;
}

}  // namespace

void write_visible_bench(const VisibleBench& bench, const std::filesystem::path& path) {
  nlohmann::json views = nlohmann::json::array();
  for (const VisibleView& view : bench.views) views.push_back({view.azimuth, view.elevation});
  const nlohmann::json json{{"footwall_visible_bench", 1},
                            {"raw", bench.raw.string()},
                            {"size", bench.size},
                            {"value", bench.value},
                            {"mode", bench.mode},
                            {"views", std::move(views)},
                            {"perspective", bench.perspective},
                            {"width", bench.width},
                            {"height", bench.height},
                            {"cell", bench.cell},
                            {"estimate_cells", bench.estimate_cells},
                            {"threads", bench.threads},
                            {"repeats", bench.repeats},
                            {"result", bench.result.string()}};
  session::write_job_json(json, path, "the path " + bench.raw.string() + ": it is not UTF-8");
}

VisibleBench read_visible_bench(const std::filesystem::path& path) {
  const nlohmann::json json = session::read_job_json(path);
  const Error odd(ErrorCode::kFormat, path.string() + " is no bench of this version",
                  "use footwall bench visible");
  try {
    if (json.at("footwall_visible_bench") != 1) throw odd;
    VisibleBench bench;
    bench.raw = json.at("raw").get<std::string>();
    bench.size = json.at("size").get<survey::Index>();
    bench.value = json.at("value").get<float>();
    bench.mode = json.at("mode").get<std::string>();
    for (const nlohmann::json& view : json.at("views"))
      bench.views.push_back({view.at(0).get<double>(), view.at(1).get<double>()});
    bench.perspective = json.at("perspective").get<bool>();
    bench.width = json.at("width").get<int>();
    bench.height = json.at("height").get<int>();
    bench.cell = json.at("cell").get<survey::Index>();
    bench.estimate_cells = json.at("estimate_cells").get<std::vector<survey::Index>>();
    bench.threads = json.at("threads").get<int>();
    bench.repeats = json.at("repeats").get<int>();
    bench.result = json.at("result").get<std::string>();
    if (bench.threads < 1 || bench.repeats < 1) throw odd;
    return bench;
  } catch (const nlohmann::json::exception&) {
    throw odd;
  }
}

std::string bench_visible(VisibleBench bench, const std::vector<std::string>& modes,
                          const std::vector<int>& ranks, session::LaunchOptions launch,
                          const JobContext& job) {
  const session::PrivateFolder folder(session::temporary_home());
  bench.raw = std::filesystem::absolute(bench.raw);
  bench.result = folder.path() / "result.json";
  bench.threads = launch.threads > 0 ? launch.threads : session::default_threads();
  const std::filesystem::path job_file = folder.path() / "BENCH.json";
  Json runs = Json::array();
  const auto all = static_cast<double>(modes.size() * ranks.size());
  for (const std::string& mode : modes) {
    bench.mode = mode;
    write_visible_bench(bench, job_file);
    Json first;
    for (const int count : ranks) {
      launch.ranks = count;
      const auto done = static_cast<double>(runs.size());
      runs.push_back(
          Json::parse(session::run_engine(launch, {{"bench-visible", job_file.string()}, bench.result},
                                          job.part(done / all, (done + 1) / all))));
      const Json common = common_of(runs.back());
      if (first.is_null()) first = common;
      if (common == first) continue;
      throw Error(ErrorCode::kInternal, fmt::format("in mode {} {} ranks find other triangles than {}", mode,
                                                    count, ranks.front()));
    }
  }
  return Json{{"runs", std::move(runs)}}.dump(1);
}

}  // namespace footwall::tasks
