#include "engine/pillars/place_text.h"

#include <fmt/format.h>
#include <cmath>

namespace footwall::pillars {
namespace {

// To a tenth, without ".0".
double tenths(double value) {
  return std::round(10 * value) / 10 + 0.0;
}

}  // namespace

std::string index_text(const survey::IndexPoint& p) {
  return fmt::format("inline index {}, crossline index {}, sample {}", tenths(p.i), tenths(p.j), tenths(p.k));
}

PlaceText place_text_of(const survey::Geometry& survey) {
  return [survey](const survey::IndexPoint& p) {
    return fmt::format("inline {}, crossline {}, {} {}",
                       tenths(survey.inlines.first + p.i * survey.inlines.step),
                       tenths(survey.crosslines.first + p.j * survey.crosslines.step),
                       tenths(survey.z0 + p.k * survey.interval), name_of(survey.vertical_unit));
  };
}

}  // namespace footwall::pillars
