// Folds and faults: which layer stands at a voxel, and where the faults are.
//
// All displacement is vertical and depends on the trace alone, so it is undone exactly: the youngest fault
// first, the folds last. Positions i, j, k are in voxels. The block above a fault (its hanging wall) has
// moved down.
#pragma once
#include <array>
#include <cstdint>

#include "storage/survey/box.h"

namespace footwall::synthetic::detail {

// What a trace knows about its layers, once for all its samples.
struct Trace {
  // Above this depth a sample belongs to the hanging wall; each depth is measured after undoing the younger
  // faults.
  double twisted_depth = 0;
  double listric_depth = 0;
  double planar_depth = 0;
  double twisted_throw = 0;  // in samples
  double listric_throw = 0;
  double planar_throw = 0;
  double fold_scale = 1;
  double fold_shift = 0;
  double modulation = 0;

  double stratigraphic_depth(double k) const {
    const double before_twisted = k - (k < twisted_depth ? twisted_throw : 0);
    const double before_listric = before_twisted - (before_twisted < listric_depth ? listric_throw : 0);
    const double before_planar = before_listric - (before_listric < planar_depth ? planar_throw : 0);
    return before_planar * fold_scale - fold_shift;
  }
};

class Structure {
 public:
  static constexpr std::int64_t kLeastFaulted = 16;  // voxels on each axis

  Structure(std::uint64_t seed, const survey::Index& size);

  bool faulted() const { return faulted_; }
  Trace trace(double i, double j) const;

  // The planar and listric faults as they were before the twisted one moved them: crossline at (i, k).
  double planar_crossline(double i, double k) const;
  double listric_crossline(double i, double k) const;
  // The twisted fault: inline at (j, k).
  double twisted_inline(double j, double k) const;

  // Throws in samples; they fall off away from the fault within the hanging wall.
  double planar_throw(double i, double j) const;
  double listric_throw(double i, double j) const;
  double twisted_throw(double i, double j) const;
  struct LargestThrows {
    double planar = 0;
    double listric = 0;
    double twisted = 0;
  };
  const LargestThrows& largest_throws() const { return throws_; }

  // The mean square of Trace::modulation over the survey.
  double modulation_mean_square() const;

 private:
  struct Bump {
    double i, j, radius, height;
  };
  double twist(double j) const;
  double relief(double i, double j) const;
  double modulation(double i, double j) const;

  bool faulted_ = false;
  std::array<double, 3> extent_{};  // index of the last voxel, at least 1

  std::array<Bump, 7> bumps_{};
  double tilt_i_ = 0, tilt_j_ = 0;
  double wave_height_ = 0, wave_i_ = 0, wave_j_ = 0, wave_phase_ = 0;
  double relief_above_ = 0.35;
  double vary_i_ = 0, vary_j_ = 0, vary_phase_ = 0;

  LargestThrows throws_;
  double planar_top_ = 0, planar_strike_ = 0, planar_slope_ = 0;
  double listric_top_ = 0, listric_strike_ = 0, listric_bow_ = 0, listric_slope_ = 0, listric_curve_ = 0;
  double twisted_centre_ = 0, twisted_strike_ = 0, twist_least_ = 0, twist_more_ = 0;
};

}  // namespace footwall::synthetic::detail
