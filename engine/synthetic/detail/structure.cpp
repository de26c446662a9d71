#include "engine/synthetic/detail/structure.h"

#include <algorithm>
#include <cmath>

#include "engine/synthetic/detail/arithmetic.h"
#include "engine/synthetic/detail/random.h"

namespace footwall::synthetic::detail {
namespace {

constexpr std::uint64_t kFoldPurpose = 2;
constexpr std::uint64_t kFaultPurpose = 3;
// Lateral voxels a sample for a dip of 60 degrees; where that would leave the survey, faults stand steeper.
constexpr double kCotangent60 = 0.5773502691896258;
// The twisted fault's tip line and where its throw is full, as fractions of the crosslines.
constexpr double kTip = 0.30;
constexpr double kTipLength = 0.35;

double decay(double distance, double length) {
  const double x = distance / length;
  return 1 / (1 + x * x);
}

}  // namespace

Structure::Structure(std::uint64_t seed, const survey::Index& size) {
  faulted_ = *std::min_element(size.begin(), size.end()) >= kLeastFaulted;
  for (int axis = 0; axis < 3; ++axis)
    extent_[axis] = static_cast<double>(std::max<std::int64_t>(size[axis] - 1, 1));
  const auto [lines, crosslines, samples] = extent_;
  const double width = std::max(lines, crosslines);
  const double height = std::min(samples, width);

  Draws fold(seed, kFoldPurpose);
  for (Bump& bump : bumps_) {
    bump.i = fold.between(0, 1) * lines;
    bump.j = fold.between(0, 1) * crosslines;
    bump.radius = fold.between(0.22, 0.5) * width;
    bump.height = fold.either_sign(0.03, 0.09) * height;
  }
  tilt_i_ = fold.between(-0.06, 0.06) * height / width;
  tilt_j_ = fold.between(-0.06, 0.06) * height / width;
  wave_height_ = fold.between(0.006, 0.014) * height;
  wave_i_ = fold.between(-2.5, 2.5) / width;
  wave_j_ = fold.either_sign(1, 2.5) / width;
  wave_phase_ = fold.between(0, 1);
  vary_i_ = fold.either_sign(0.4, 1.2) / width;
  vary_j_ = fold.either_sign(0.4, 1.2) / width;
  vary_phase_ = fold.between(0, 1);
  if (!faulted_) return;

  Draws draws(seed, kFaultPurpose);
  const double usual_throw = std::clamp(samples / 18, 2.0, 16.0);
  throws_.planar = draws.between(0.85, 1.05) * usual_throw;
  throws_.listric = draws.between(1.0, 1.25) * usual_throw;
  throws_.twisted = draws.between(0.8, 1.0) * usual_throw;

  planar_top_ = draws.between(0.07, 0.12) * crosslines;
  planar_strike_ = draws.between(-0.08, 0.08) * crosslines / lines;
  planar_slope_ = std::min(kCotangent60, 0.5 * crosslines / samples);

  listric_top_ = draws.between(0.48, 0.54) * crosslines;
  listric_strike_ = draws.between(-0.06, 0.06) * crosslines / lines;
  listric_bow_ = draws.either_sign(0.02, 0.05) * crosslines;
  const double reach = std::min(0.6 * samples, 0.36 * crosslines);
  listric_slope_ = 0.25 * reach / samples;
  listric_curve_ = 0.75 * reach / (samples * samples);

  twisted_centre_ = draws.between(0.46, 0.54) * lines;
  twisted_strike_ = draws.either_sign(0.04, 0.12) * lines / crosslines;
  const double steepest = std::min(kCotangent60, 0.55 * lines / samples);
  twist_least_ = 0.2 * steepest;
  twist_more_ = 0.8 * steepest;
}

Trace Structure::trace(double i, double j) const {
  Trace trace;
  const double fold = relief(i, j);
  // Folds grow with depth, from relief_above_ of the full relief at the top.
  trace.fold_scale = 1 - fold * (1 - relief_above_) / extent_[2];
  trace.fold_shift = fold * relief_above_;
  trace.modulation = modulation(i, j);
  if (!faulted_) return trace;
  trace.twisted_throw = twisted_throw(i, j);
  trace.listric_throw = listric_throw(i, j);
  trace.planar_throw = planar_throw(i, j);
  trace.twisted_depth = 0.5 * extent_[2] + (i - twisted_inline(j, 0.5 * extent_[2])) / twist(j);
  trace.planar_depth = (j - planar_crossline(i, 0)) / planar_slope_;
  // The listric fault's depth: the larger root, where its curve goes down.
  const double beyond = j - listric_crossline(i, 0);
  const double discriminant = listric_slope_ * listric_slope_ + 4 * listric_curve_ * beyond;
  trace.listric_depth =
      discriminant < 0 ? -extent_[2] : (std::sqrt(discriminant) - listric_slope_) / (2 * listric_curve_);
  return trace;
}

double Structure::planar_crossline(double i, double k) const {
  return planar_top_ + planar_strike_ * (i - 0.5 * extent_[0]) + planar_slope_ * k;
}

double Structure::listric_crossline(double i, double k) const {
  const double off_centre = 2 * i / extent_[0] - 1;
  return listric_top_ + listric_strike_ * (i - 0.5 * extent_[0]) +
         listric_bow_ * (off_centre * off_centre - 0.5) + (listric_slope_ + listric_curve_ * k) * k;
}

double Structure::twist(double j) const {
  return twist_least_ + twist_more_ * (j / extent_[1]);
}

double Structure::twisted_inline(double j, double k) const {
  return twisted_centre_ + twisted_strike_ * (j - 0.5 * extent_[1]) + twist(j) * (k - 0.5 * extent_[2]);
}

double Structure::planar_throw(double i, double j) const {
  return throws_.planar * decay(j - planar_crossline(i, 0), 1.3 * extent_[1]);
}

double Structure::listric_throw(double i, double j) const {
  return throws_.listric * decay(j - listric_crossline(i, 0), 0.8 * extent_[1]);
}

double Structure::twisted_throw(double i, double j) const {
  return throws_.twisted * smooth_step((j / extent_[1] - kTip) / kTipLength) *
         decay(i - twisted_inline(j, 0), 1.3 * extent_[0]);
}

double Structure::relief(double i, double j) const {
  double sum = tilt_i_ * (i - 0.5 * extent_[0]) + tilt_j_ * (j - 0.5 * extent_[1]);
  for (const Bump& bump : bumps_) {
    const double di = (i - bump.i) / bump.radius;
    const double dj = (j - bump.j) / bump.radius;
    const double inside = 1 - (di * di + dj * dj);
    if (inside > 0) sum += bump.height * inside * inside * inside;
  }
  return sum + wave_height_ * sine_of_turns(wave_i_ * i + wave_j_ * j + wave_phase_);
}

double Structure::modulation(double i, double j) const {
  return sine_of_turns(vary_i_ * i + vary_phase_) * sine_of_turns(vary_j_ * j + 2 * vary_phase_);
}

double Structure::modulation_mean_square() const {
  constexpr int kPerAxis = 32;
  double sum = 0;
  for (int a = 0; a < kPerAxis; ++a) {
    for (int b = 0; b < kPerAxis; ++b) {
      const double m = modulation((a + 0.5) / kPerAxis * extent_[0], (b + 0.5) / kPerAxis * extent_[1]);
      sum += m * m;
    }
  }
  return sum / (kPerAxis * kPerAxis);
}

}  // namespace footwall::synthetic::detail
