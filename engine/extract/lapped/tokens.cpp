#include "engine/extract/lapped/tokens.h"

namespace footwall::extract::lapped {
namespace {

constexpr double kFirstBound = 0.6;  // of class 0, in sixteenths; each further one is so much larger
constexpr double kBoundRatio = 1.35;
constexpr double kSpread = 2.1;
constexpr double kLeastMean = 0.15;

constexpr Classes make_classes() {
  Classes classes{};
  double bound = kFirstBound;
  std::uint8_t now = 0;
  for (std::size_t expected = 0; expected < classes.size(); ++expected) {
    while (static_cast<double>(expected) > bound && now + 1U < kClasses) {
      bound *= kBoundRatio;
      ++now;
    }
    classes[expected] = now;
  }
  return classes;
}

// The mean magnitude that a class stands for: between its bounds.
constexpr double mean_of(std::size_t of_class) {
  double bound = kFirstBound;
  for (std::size_t n = 0; n < of_class; ++n) bound *= kBoundRatio;
  const double middle = of_class == 0 ? 0.5 * bound : 0.5 * (bound + bound / kBoundRatio);
  return middle / 16;
}

constexpr double density(double magnitude, double scale) {
  const double base = 1 / (1 + magnitude / scale * (magnitude / scale));
  return base * base * base;
}

// The sum over a token's magnitudes of both signs, from a few of them.
constexpr double weight_of(std::uint32_t token, double scale) {
  constexpr int kPoints = 8;
  const double width = static_cast<double>(1U << extra_bits_of(token));
  double sum = 0;
  for (int n = 0; n < kPoints; ++n) {
    const double part = (n + 0.5) / kPoints;
    const double at = token == 0 ? 0.5 * part : first_of(token) + (width - 1) * part;
    sum += density(at, scale);
  }
  return sum / kPoints * width * (token == 0 ? 1 : 2);
}

constexpr Shares make_shares(std::size_t of_class) {
  const double scale = kSpread * (mean_of(of_class) + kLeastMean);
  std::array<double, kTokens> weight{};
  double total = 0;
  for (std::uint32_t token = 0; token < kTokens; ++token) total += weight[token] = weight_of(token, scale);
  constexpr std::uint32_t kWhole = 1U << kFrequencyBits;
  std::array<std::uint32_t, kTokens> share{};
  std::uint32_t used = 0;
  std::size_t largest = 0;
  for (std::size_t token = 0; token < kTokens; ++token) {
    share[token] = 1 + static_cast<std::uint32_t>(weight[token] / total * (kWhole - kTokens));
    used += share[token];
    if (share[token] > share[largest]) largest = token;
  }
  share[largest] += kWhole - used;  // what rounding left over
  Shares starts{};
  for (std::size_t token = 0; token < kTokens; ++token) {
    starts[token + 1] = static_cast<std::uint16_t>(starts[token] + share[token]);
  }
  return starts;
}

constexpr std::array<Shares, kClasses> make_all_shares() {
  std::array<Shares, kClasses> all{};
  for (std::size_t n = 0; n < kClasses; ++n) all[n] = make_shares(n);
  return all;
}

constexpr Classes kClassOf = make_classes();
constexpr std::array<Shares, kClasses> kShares = make_all_shares();

}  // namespace

const Classes& classes() {
  return kClassOf;
}

const Shares& shares_of(std::uint32_t of_class) {
  return kShares[of_class];
}

}  // namespace footwall::extract::lapped
