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

}  // namespace

void take_camera(const std::string& words, render::View& into) {
  const bool has_digits = words.find_first_of("0123456789") != std::string::npos;
  if (!has_digits || (words.find(',') == std::string::npos && words.find(';') == std::string::npos)) {
    throw Error(ErrorCode::kNotFound,
                fmt::format("there is no saved view '{}': projects keep none yet", words),
                wrong(words).hint());
  }
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

}  // namespace footwall::tasks
