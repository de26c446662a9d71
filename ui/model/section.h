// A plane on which an interpreter looks at a volume and picks.
#pragma once
#include <QString>
#include <cstdint>

#include "storage/survey/geometry.h"

namespace footwall::ui {

struct Section {
  enum class Kind : std::uint8_t { kInline, kCrossline, kSlice, kLine };
  Kind kind = Kind::kInline;
  std::int64_t index = 0;           // inline, crossline or sample index from 0; of a line: unused
  survey::IndexPoint from{}, to{};  // of a line: its ends in index space; k unused
  friend bool operator==(const Section&, const Section&) = default;
};

// "Inline 412", "Time slice 1238 ms", "Line 412/700 - 455/733".
QString title_of(const Section& section, const survey::Geometry& survey);
// Clamped to the survey; a line stays as it is.
Section stepped(const Section& section, std::int64_t by, const survey::Geometry& survey);
std::int64_t last_index(const Section& section, const survey::Geometry& survey);

// The plane's own coordinates: u to the right and v down, both in voxels. Inline: u = crossline index, v =
// sample; crossline: u = inline index, v = sample; slice: u = crossline index, v = inline index (a view may
// draw it upwards); line: u = distance from `from` in voxels, v = sample.
struct PlanePoint {
  double u = 0;
  double v = 0;
  friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};
PlanePoint plane_of(const Section& section, const survey::IndexPoint& p);
survey::IndexPoint index_of(const Section& section, const PlanePoint& p);
// Signed distance of a point from the plane, in voxels.
double distance_from(const Section& section, const survey::IndexPoint& p);
// Width and height in voxels: u runs [-1/2, width - 1/2], v alike.
struct PlaneSize {
  double width = 1;
  double height = 1;
};
PlaneSize size_of(const Section& section, const survey::Geometry& survey);

}  // namespace footwall::ui
