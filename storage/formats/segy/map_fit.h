// The affine map from line numbers to X and Y, by least squares over all traces, from sums alone: no
// coordinate has to be kept.
#pragma once
#include <cstdint>

namespace footwall::formats::segy {

// Moments of two line numbers and two coordinates about the first trace that was added.
struct Moments {
  std::int64_t count = 0;
  double u0 = 0, v0 = 0, x0 = 0, y0 = 0;
  long double u = 0, v = 0, x = 0, y = 0;
  long double uu = 0, uv = 0, vv = 0, ux = 0, vx = 0, uy = 0, vy = 0, xx = 0, yy = 0;

  void add(double line, double crossline, double easting, double northing);
};

struct MapFit {
  enum class Kind : std::uint8_t {
    kPlane,      // both directions are known
    kInline,     // all traces on one inline: only the direction along it (per crossline) is known
    kCrossline,  // all traces on one crossline: only per inline is known
    kPoint,      // one position
    kUnusable    // none, or positions that do not spread as the lines do
  };
  Kind kind = Kind::kUnusable;
  // At line numbers (u, v): origin + per_u * (u - u0) + per_v * (v - v0).
  double u0 = 0, v0 = 0;
  double origin_x = 0, origin_y = 0;
  double per_u_x = 0, per_u_y = 0, per_v_x = 0, per_v_y = 0;
  double residual = 0;  // root mean square distance
};

MapFit fit_map(const Moments& moments);

// The shorter distance between neighbouring line numbers; 0 for one position.
double bin_of(const MapFit& fit);

// The residual as a share of bin_of(); 0 for one position, NaN
// for an unusable fit.
double misfit_in_bins(const MapFit& fit);

}  // namespace footwall::formats::segy
