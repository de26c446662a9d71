#include "storage/formats/segy/map_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footwall::formats::segy {

void Moments::add(double line, double crossline, double easting, double northing) {
  if (count == 0) {
    u0 = line;
    v0 = crossline;
    x0 = easting;
    y0 = northing;
  }
  const long double du = line - u0, dv = crossline - v0, dx = easting - x0, dy = northing - y0;
  ++count;
  u += du;
  v += dv;
  x += dx;
  y += dy;
  uu += du * du;
  uv += du * dv;
  vv += dv * dv;
  ux += du * dx;
  vx += dv * dx;
  uy += du * dy;
  vy += dv * dy;
  xx += dx * dx;
  yy += dy * dy;
}

MapFit fit_map(const Moments& m) {
  MapFit fit;
  if (m.count == 0) return fit;
  const long double n = static_cast<long double>(m.count);
  const auto about_mean = [n](long double product, long double a, long double b) {
    return product - a * b / n;
  };
  const long double uu = about_mean(m.uu, m.u, m.u), vv = about_mean(m.vv, m.v, m.v),
                    uv = about_mean(m.uv, m.u, m.v);
  const long double ux = about_mean(m.ux, m.u, m.x), uy = about_mean(m.uy, m.u, m.y);
  const long double vx = about_mean(m.vx, m.v, m.x), vy = about_mean(m.vy, m.v, m.y);
  // Line numbers are integers, so a spread below this is rounding.
  constexpr long double kNothing = 1e-6L;
  const bool along_u = uu > kNothing, along_v = vv > kNothing;
  long double a_x = 0, a_y = 0, b_x = 0, b_y = 0;
  if (along_u && along_v) {
    const long double det = uu * vv - uv * uv;
    if (det <= 1e-9L * uu * vv) return fit;  // all traces on one diagonal: two directions cannot be told
    a_x = (ux * vv - vx * uv) / det;
    a_y = (uy * vv - vy * uv) / det;
    b_x = (vx * uu - ux * uv) / det;
    b_y = (vy * uu - uy * uv) / det;
    const long double area = std::fabs(a_x * b_y - a_y * b_x);
    if (!(area > 1e-4L * std::hypot(a_x, a_y) * std::hypot(b_x, b_y))) return fit;
    fit.kind = MapFit::Kind::kPlane;
  } else if (along_v) {
    b_x = vx / vv;
    b_y = vy / vv;
    if (!(std::hypot(b_x, b_y) > 0)) return fit;
    fit.kind = MapFit::Kind::kInline;
  } else if (along_u) {
    a_x = ux / uu;
    a_y = uy / uu;
    if (!(std::hypot(a_x, a_y) > 0)) return fit;
    fit.kind = MapFit::Kind::kCrossline;
  } else {
    fit.kind = MapFit::Kind::kPoint;
  }
  fit.u0 = m.u0;
  fit.v0 = m.v0;
  fit.origin_x = static_cast<double>(m.x0 + (m.x - a_x * m.u - b_x * m.v) / n);
  fit.origin_y = static_cast<double>(m.y0 + (m.y - a_y * m.u - b_y * m.v) / n);
  fit.per_u_x = static_cast<double>(a_x);
  fit.per_u_y = static_cast<double>(a_y);
  fit.per_v_x = static_cast<double>(b_x);
  fit.per_v_y = static_cast<double>(b_y);
  const long double squares = about_mean(m.xx, m.x, m.x) - a_x * ux - b_x * vx +  //
                              about_mean(m.yy, m.y, m.y) - a_y * uy - b_y * vy;
  fit.residual = static_cast<double>(std::sqrt(std::max(squares, 0.0L) / n));
  return fit;
}

double bin_of(const MapFit& fit) {
  const double along_u = std::hypot(fit.per_u_x, fit.per_u_y);
  const double along_v = std::hypot(fit.per_v_x, fit.per_v_y);
  return along_u > 0 && along_v > 0 ? std::min(along_u, along_v) : std::max(along_u, along_v);
}

double misfit_in_bins(const MapFit& fit) {
  if (fit.kind == MapFit::Kind::kUnusable) return std::numeric_limits<double>::quiet_NaN();
  if (fit.kind == MapFit::Kind::kPoint) return 0;
  return fit.residual / bin_of(fit);
}

}  // namespace footwall::formats::segy
