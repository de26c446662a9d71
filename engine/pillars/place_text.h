// How messages name a place: the interpreter looks for it on a section, not in index space.
#pragma once
#include <functional>
#include <string>

#include "storage/survey/geometry.h"
#include "storage/survey/points.h"

namespace footwall::pillars {

using PlaceText = std::function<std::string(const survey::IndexPoint&)>;

// "inline index 12, crossline index 30.5, sample 44.2": where no survey is at hand.
std::string index_text(const survey::IndexPoint& p);
// "inline 1072, crossline 230.5, 1160 ms".
PlaceText place_text_of(const survey::Geometry& survey);

}  // namespace footwall::pillars
