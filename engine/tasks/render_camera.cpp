#include "engine/tasks/render_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

Error wrong(const std::string& words) {
  return {
      ErrorCode::kUsage, fmt::format("--camera {} is no camera", words),
      "write azimuth,elevation,zoom as 30,25,1, or eye;target;up as 0,-5000,2000;0,0,0;0,0,1 (metres east, "
      "north and up from the survey's centre)"};
}

std::vector<double> numbers_of(std::string_view part, const std::string& words) {
  std::vector<double> numbers;
  for (const std::string_view word : text::split(part, ',')) {
    const auto number = text::number(word);
    if (!number) throw wrong(words);
    numbers.push_back(*number);
  }
  return numbers;
}

bool is_name(const std::string& words) {
  return words.find_first_of("0123456789") == std::string::npos ||
         words.find_first_of(",;") == std::string::npos;
}

void take_numbers(const std::string& words, render::View& into) {
  const std::vector<std::string_view> parts = text::split(words, ';');
  if (parts.size() == 1) {
    const std::vector<double> numbers = numbers_of(words, words);
    if (numbers.size() < 2 || numbers.size() > 3) throw wrong(words);
    into.azimuth_degrees = numbers[0];
    into.elevation_degrees = numbers[1];
    into.zoom = numbers.size() == 3 ? numbers[2] : 1;
    return;
  }
  if (parts.size() > 3) throw wrong(words);
  std::vector<render::Vec3> places;
  for (const std::string_view part : parts) {
    const std::vector<double> numbers = numbers_of(part, words);
    if (numbers.size() != 3) throw wrong(words);
    places.push_back({numbers[0], numbers[1], numbers[2]});
  }
  into.look_at = render::LookAt{places[0], places[1]};
  if (places.size() == 3) into.look_at->up = places[2];
}

}  // namespace

void take_camera(const project::Project& project, const std::string& words, render::View& into) {
  for (const project::ViewRecord& view : project.views()) {
    if (view.name != words) continue;
    take_numbers(view.camera, into);
    if (into.exaggeration == 0) into.exaggeration = view.exaggeration;
    return;
  }
  if (is_name(words)) project.view(words);  // throws, and tells the names there are
  take_numbers(words, into);
}

std::string camera_words(const render::View& view) {
  const auto place = [](const render::Vec3& p) { return fmt::format("{},{},{}", p.x, p.y, p.z); };
  if (view.look_at) {
    return fmt::format("{};{};{}", place(view.look_at->eye), place(view.look_at->target),
                       place(view.look_at->up));
  }
  if (!view.azimuth_degrees) {
    throw Error(ErrorCode::kUsage, "a view is saved with the direction that it looks in",
                "give --camera or --azimuth, too");
  }
  return fmt::format("{},{},{}", *view.azimuth_degrees, view.elevation_degrees, view.zoom);
}

}  // namespace footwall::tasks
