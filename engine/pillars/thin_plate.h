// Thin-plate spline in two dimensions: h = sum l_i r_i^2 log r_i + a0 + a1 x + a2 y.
// Based on: Duchon 1977; the reduction to a positive definite system: Wahba, spline models for observational
// data, 1990. All sums run in a fixed order and the logarithm is our own, so that every machine gives the
// same bits.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "storage/base/job_context.h"

namespace footwall::pillars {

struct PlateNode {
  double x = 0, y = 0, height = 0;
};

class ThinPlate {
 public:
  // smoothing >= 0; 0 passes through every node. Nodes at one place are merged to their mean. Time grows with
  // the cube, memory with the square of the number of nodes. Throws Error kInvalid if the places are fewer
  // than three or all on one line, kCancelled.
  ThinPlate(std::span<const PlateNode> nodes, double smoothing, const JobContext& job);
  double height(double x, double y) const;

 private:
  std::vector<PlateNode> nodes_;  // in units of scale_ about (x0_, y0_)
  std::vector<double> weights_;
  std::array<double, 3> plane_{0, 0, 0};
  double x0_ = 0, y0_ = 0, scale_ = 1;
};

// log(x) for finite x > 0 from + - * / alone, to within 2 units in the last place.
double portable_log(double x);

}  // namespace footwall::pillars
