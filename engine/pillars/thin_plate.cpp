#include "engine/pillars/thin_plate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

double kernel(double dx, double dy) {
  const double r2 = dx * dx + dy * dy;
  return r2 > 0 ? 0.5 * r2 * portable_log(r2) : 0;
}

// A Householder reflection I - 2 v v^T of unit vectors.
using Reflections = std::array<std::vector<double>, 3>;

void reflect(const std::vector<double>& v, double* x, std::size_t stride) {
  double sum = 0;
  for (std::size_t n = 0; n < v.size(); ++n) sum += v[n] * x[n * stride];
  for (std::size_t n = 0; n < v.size(); ++n) x[n * stride] -= 2 * sum * v[n];
}

// A <- H A H for symmetric A: A - v w^T - w v^T with w = 2 (A v - (v^T A v) v).
void reflect_both(const std::vector<double>& v, std::vector<double>& a) {
  const std::size_t n = v.size();
  std::vector<double> w(n, 0.0);
  double quadratic = 0;
  for (std::size_t r = 0; r < n; ++r) {
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += a[r * n + c] * v[c];
    w[r] = sum;
    quadratic += sum * v[r];
  }
  for (std::size_t r = 0; r < n; ++r) w[r] = 2 * (w[r] - quadratic * v[r]);
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < n; ++c) a[r * n + c] -= v[r] * w[c] + w[r] * v[c];
}

// LDL^T in the lower triangle of rows `from`.. of a, in place, by blocks of columns: the inner loop runs over
// independent elements, so that it vectorizes without changing any sum.
void factor(std::vector<double>& a, std::size_t n, std::size_t from, const JobContext& job) {
  constexpr std::size_t kBlock = 8;
  std::vector<double> columns(kBlock * n);
  for (std::size_t k0 = from; k0 < n; k0 += kBlock) {
    job.check();
    const std::size_t k1 = std::min(n, k0 + kBlock);
    for (std::size_t k = k0; k < k1; ++k) {
      const double d = a[k * n + k];
      if (!(d > 0))
        throw Error(ErrorCode::kInvalid, "the thin plate through the pillars' nodes is not defined");
      double* column = &columns[(k - k0) * n];
      for (std::size_t r = k + 1; r < n; ++r) {
        column[r] = a[r * n + k];  // L times d
        a[r * n + k] = column[r] / d;
      }
      for (std::size_t r = k + 1; r < n; ++r)
        for (std::size_t c = k + 1; c < std::min(k1, r + 1); ++c) a[r * n + c] -= a[r * n + k] * column[c];
    }
    if (k1 - k0 < kBlock) break;
    const double* l = columns.data();
    for (std::size_t r = k1; r < n; ++r) {
      double* row = &a[r * n];
      const double f0 = row[k0], f1 = row[k0 + 1], f2 = row[k0 + 2], f3 = row[k0 + 3];
      const double f4 = row[k0 + 4], f5 = row[k0 + 5], f6 = row[k0 + 6], f7 = row[k0 + 7];
      for (std::size_t c = k1; c <= r; ++c)
        row[c] -= ((f0 * l[c] + f1 * l[n + c]) + (f2 * l[2 * n + c] + f3 * l[3 * n + c])) +
                  ((f4 * l[4 * n + c] + f5 * l[5 * n + c]) + (f6 * l[6 * n + c] + f7 * l[7 * n + c]));
    }
  }
}

std::vector<PlateNode> merged(std::span<const PlateNode> nodes) {
  std::vector<PlateNode> sorted(nodes.begin(), nodes.end());
  std::sort(sorted.begin(), sorted.end(), [](const PlateNode& a, const PlateNode& b) {
    return std::tie(a.x, a.y, a.height) < std::tie(b.x, b.y, b.height);
  });
  std::vector<PlateNode> out;
  for (std::size_t n = 0; n < sorted.size();) {
    std::size_t end = n;
    double sum = 0;
    for (; end < sorted.size() && sorted[end].x == sorted[n].x && sorted[end].y == sorted[n].y; ++end)
      sum += sorted[end].height;
    out.push_back({sorted[n].x, sorted[n].y, sum / double(end - n)});
    n = end;
  }
  return out;
}

}  // namespace

double portable_log(double x) {
  require(x > 0 && std::isfinite(x), "portable_log of a finite positive number");
  // x = m 2^e with m in [sqrt 1/2, sqrt 2); log m = 2 atanh z by its series, |z| < 0.172.
  int e = 0;
  double m = std::frexp(x, &e);
  if (m < 0.70710678118654752440) m *= 2, --e;
  const double z = (m - 1) / (m + 1), z2 = z * z;
  double sum = 0;
  for (int k = 25; k >= 3; k -= 2) sum = (sum + 1.0 / k) * z2;
  return e * 0.69314718055994530942 + 2 * z * (1 + sum);
}

ThinPlate::ThinPlate(std::span<const PlateNode> given, double smoothing, const JobContext& job)
    : nodes_(merged(given)) {
  const std::size_t n = nodes_.size();
  auto refuse = [] {
    throw Error(ErrorCode::kInvalid, "the pillars' nodes all lie on one line",
                "pick the fault on further sections");
  };
  if (n < 3) refuse();
  // 1. About the middle, in units of the extent: the kernel's numbers stay near one.
  for (const PlateNode& p : nodes_) x0_ += p.x, y0_ += p.y;
  x0_ /= double(n), y0_ /= double(n);
  scale_ = 0;
  for (const PlateNode& p : nodes_) scale_ = std::max({scale_, std::abs(p.x - x0_), std::abs(p.y - y0_)});
  for (PlateNode& p : nodes_) p.x = (p.x - x0_) / scale_, p.y = (p.y - y0_) / scale_;

  // 2. K, and Q = [1 x y] turned into an upper triangle by three reflections.
  std::vector<double> k(n * n);
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < r; ++c)
      k[r * n + c] = k[c * n + r] = kernel(nodes_[r].x - nodes_[c].x, nodes_[r].y - nodes_[c].y);
    k[r * n + r] = smoothing;
  }
  job.check();
  std::vector<double> q(3 * n);  // by column
  std::vector<double> y(n);
  for (std::size_t r = 0; r < n; ++r)
    q[r] = 1, q[n + r] = nodes_[r].x, q[2 * n + r] = nodes_[r].y, y[r] = nodes_[r].height;
  Reflections h;
  for (std::size_t c = 0; c < 3; ++c) {
    double norm2 = 0;
    for (std::size_t r = c; r < n; ++r) norm2 += q[c * n + r] * q[c * n + r];
    if (!(norm2 > 1e-18 * double(n))) refuse();
    const double norm = std::sqrt(norm2), pivot = q[c * n + c] >= 0 ? -norm : norm;
    h[c].assign(n, 0.0);
    for (std::size_t r = c; r < n; ++r) h[c][r] = q[c * n + r];
    h[c][c] -= pivot;
    double length2 = 0;
    for (double v : h[c]) length2 += v * v;
    const double length = std::sqrt(length2);
    for (double& v : h[c]) v /= length;
    for (std::size_t each = c; each < 3; ++each) reflect(h[c], &q[each * n], 1);
    reflect(h[c], y.data(), 1);
  }
  for (const auto& v : h) reflect_both(v, k);

  // 3. On the null space (rows 3..) K is positive definite: solve for the turned weights there. Rows 0..2
  // then
  //    give the plane.
  std::vector<double> weights(n, 0.0);
  if (n > 3) {
    std::vector<double> l(k);
    factor(l, n, 3, job);
    for (std::size_t r = 3; r < n; ++r) {
      double sum = y[r];
      for (std::size_t c = 3; c < r; ++c) sum -= l[r * n + c] * weights[c];
      weights[r] = sum;
    }
    for (std::size_t r = 3; r < n; ++r) weights[r] /= l[r * n + r];
    for (std::size_t r = n; r-- > 3;)
      for (std::size_t c = 3; c < r; ++c) weights[c] -= l[r * n + c] * weights[r];
  }
  std::array<double, 3> rest{};
  for (std::size_t r = 0; r < 3; ++r) {
    rest[r] = y[r];
    for (std::size_t c = 3; c < n; ++c) rest[r] -= k[r * n + c] * weights[c];
  }
  for (std::size_t r = 3; r-- > 0;) {
    double sum = rest[r];
    for (std::size_t c = r + 1; c < 3; ++c) sum -= q[c * n + r] * plane_[c];
    plane_[r] = sum / q[r * n + r];
  }
  for (std::size_t c = 3; c-- > 0;) reflect(h[c], weights.data(), 1);
  weights_ = std::move(weights);
}

double ThinPlate::height(double x, double y) const {
  const double u = (x - x0_) / scale_, v = (y - y0_) / scale_;
  double sum = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    sum += weights_[n] * kernel(u - nodes_[n].x, v - nodes_[n].y);
  return sum + plane_[0] + plane_[1] * u + plane_[2] * v;
}

}  // namespace footwall::pillars
