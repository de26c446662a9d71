// The surface that a panel is measured against: its height anywhere inside the panel.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "engine/pillars/course.h"

namespace footwall::pillars {

class Reference {
 public:
  virtual ~Reference() = default;
  // The height over a chart position inside the panel. Not thread-safe: keeps its last place.
  virtual double height(double strike, double dip) = 0;
};

// The ruled surface between two courses at equal normalised length, `a` to the left of `b` where both run up
// the page. Null where it is not single-valued over the chart.
std::unique_ptr<Reference> ruled_surface(const Course& a, const Course& b);

// Mean value interpolation of the heights along a simple closed rim: its points in order, counter-clockwise.
// Points on a straight run of it change nothing and cost nothing.
// Based on: Floater, mean value coordinates, 2003; Hormann and Floater, mean value coordinates for arbitrary
// planar polygons, 2006. tan(angle / 2) is taken as cross / (r r' + dot), so that no trigonometric function
// is needed.
std::unique_ptr<Reference> mean_value_surface(std::span<const ChartPoint> loop);

}  // namespace footwall::pillars
