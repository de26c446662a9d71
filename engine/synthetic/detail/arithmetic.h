// Functions that give the same bits everywhere: + - * / in a fixed order, no C library.
#pragma once
#include <cstdint>

namespace footwall::synthetic::detail {

// exp(-x) for 0 <= x <= 700, relative error below 1e-13: the Taylor series of exp(x/2^10), squared ten times.
inline double exp_of_minus(double x) {
  const double small = x / 1024;
  double sum = 1;
  for (int n = 12; n >= 1; --n) sum = 1 + sum * small / n;
  for (int n = 0; n < 10; ++n) sum *= sum;
  return 1 / sum;
}

// sin(2 pi x), |x| < 2^31, error below 1e-9: folded into a quarter turn, Taylor to degree 13.
inline double sine_of_turns(double x) {
  const double whole = static_cast<double>(static_cast<std::int64_t>(x < 0 ? x - 0.5 : x + 0.5));
  double turn = x - whole;
  if (turn > 0.25) turn = 0.5 - turn;
  if (turn < -0.25) turn = -0.5 - turn;
  const double angle = turn * 6.283185307179586;
  const double square = angle * angle;
  double sum = 1;
  for (int n = 12; n >= 2; n -= 2) sum = 1 - sum * square / (n * (n + 1));
  return angle * sum;
}

// 0 for x <= 0, 1 for x >= 1, with level ends.
inline double smooth_step(double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x * x * (3 - 2 * x);
}

}  // namespace footwall::synthetic::detail
