#include "engine/tasks/visible.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "engine/render/picture.h"
#include "storage/base/error.h"
#include "storage/formats/png.h"

namespace footwall::tasks {

PassImages::PassImages(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (!are_wanted()) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (std::filesystem::is_directory(folder_)) return;
  if (std::filesystem::exists(folder_)) {
    throw Error(ErrorCode::kUsage, fmt::format("--pass-images {} is no folder", folder_.string()),
                "name a folder for the pictures, which is made if it is not there");
  }
  throw io_error("make the folder", folder_.string(), error.value());
}

void PassImages::write(const session::VisibleChoice& choice, int count, const render::Composition& made,
                       int width, int height, int threads, const JobContext& job) {
  for (int n = 1; n <= count; ++n) {
    job.report(static_cast<double>(n - 1) / count, "pass images", fmt::format("{} of {}", n - 1, count));
    const auto layer = render::SurfaceLayer::read(choice.pass_layer(n));
    const render::Picture picture = render::render(made.scene, made.camera, width, height, threads, &layer);
    const std::filesystem::path path = folder_ / fmt::format("pass-{:03}.png", n);
    formats::write_png(path, picture.width, picture.height, picture.rgba);
    paths_.push_back(path.string());
  }
}

void count_pixels(nlohmann::json& report) {
  constexpr std::int64_t kOfPixel = std::int64_t{render::kSamples} * render::kSamples;
  const auto count = [](nlohmann::json& uncovered) {
    uncovered = (uncovered.get<std::int64_t>() + kOfPixel - 1) / kOfPixel;
  };
  count(report.at("uncovered_pixels"));
  for (nlohmann::json& pass : report.at("passes")) count(pass.at("uncovered_pixels"));
}

std::string end_notice(const std::string& name, const session::VisibleChoice& choice,
                       const nlohmann::json& report) {
  if (report.at("finished").get<bool>()) return {};
  const std::size_t passes = report.at("passes").size();
  const bool is_counted = choice.passes > 0 && passes == static_cast<std::size_t>(choice.passes);
  return fmt::format(
      "{} is not finished: {} ended it after {} pass{}; about {} pixels show nothing yet that "
      "may belong to it",
      name, is_counted ? "--passes" : "--budget", passes, passes == 1 ? "" : "es",
      report.at("uncovered_pixels").get<std::int64_t>());
}

}  // namespace footwall::tasks
