// Where a triangle mesh passes through a section.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "ui/model/section.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

struct CutSegment {
  std::array<PlanePoint, 2> ends;
  std::size_t face = 0;  // the place in `faces` of one that it lies in
  const PlanePoint& operator[](std::size_t n) const { return ends[n]; }
  auto begin() const { return ends.begin(); }
  auto end() const { return ends.end(); }
};

// The closed triangles' common points with the plane, without those that are single points: each crossing as
// a segment, an edge that lies in the plane once, a face that lies in it as its edges. No ends beyond those
// of a line section unless the triangle reaches there; the caller cuts off what it does not show.
std::vector<CutSegment> mesh_cut(const Section& section, std::span<const survey::IndexPoint> places,
                                 std::span<const project::MeshFace> faces);

// The segments end to end, as few lines as forks allow; each segment is in one of them.
using CutLine = std::vector<PlanePoint>;
std::vector<CutLine> joined(std::span<const CutSegment> segments);

}  // namespace footwall::ui
