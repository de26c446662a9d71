#include "engine/extract/lapped/transform.h"

namespace footwall::extract::lapped {
namespace {

// cos(j pi / 16), each the double nearest.
constexpr std::array<double, 9> kCosine{1.0,
                                        0.9807852804032304,
                                        0.9238795325112867,
                                        0.8314696123025452,
                                        0.7071067811865476,
                                        0.5555702330196022,
                                        0.3826834323650898,
                                        0.19509032201612828,
                                        0.0};

constexpr double cosine(std::size_t j) {
  j %= 32;
  if (j > 16) j = 32 - j;
  return j <= 8 ? kCosine[j] : -kCosine[16 - j];
}

// The cosine transform of type II, orthonormal: value t of its basis vector k.
constexpr double dct(std::size_t t, std::size_t k) {
  return 0.5 * (k == 0 ? kCosine[4] : cosine((2 * t + 1) * k));
}

struct Rotation {
  double cosine;
  double sine;
};

constexpr Basis basis_of(const std::array<Rotation, 3>& rotations) {
  // With De and Do the even and odd vectors of the cosine transform and J the mirror, the first four columns
  // are [De-Do; J(De-Do)] / 2 and the last four [De-Do; -J(De-Do)] / 2, which the rotations then mix.
  Basis columns{};
  for (std::size_t t = 0; t < kBands; ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const double difference = 0.5 * (dct(t, 2 * n) - dct(t, 2 * n + 1));
      columns[t][n] = columns[t][4 + n] = difference;
      columns[kTaps - 1 - t][n] = difference;
      columns[kTaps - 1 - t][4 + n] = -difference;
    }
  }
  for (std::size_t r = 0; r < rotations.size(); ++r) {
    for (auto& row : columns) {
      const double a = row[4 + r];
      const double b = row[5 + r];
      row[4 + r] = rotations[r].cosine * a - rotations[r].sine * b;
      row[5 + r] = rotations[r].sine * a + rotations[r].cosine * b;
    }
  }
  // Column n of each four has frequency 2 n or 2 n + 1.
  Basis ordered{};
  for (std::size_t t = 0; t < kTaps; ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      ordered[t][2 * n] = columns[t][n];
      ordered[t][2 * n + 1] = columns[t][4 + n];
    }
  }
  return ordered;
}

constexpr Basis kStandard = basis_of({Rotation{0.9177546256839811, 0.3971478906347806},
                                      Rotation{0.8763066800438636, 0.48175367410171527},
                                      Rotation{0.9177546256839811, 0.3971478906347806}});
constexpr Basis kTuned = basis_of({Rotation{0.8015669848708765, 0.5979049830575188},
                                   Rotation{0.5490228179981318, -0.8358073613682703},
                                   Rotation{0.9932518590423394, -0.11597734480896137}});

}  // namespace

const Basis& basis(Angles angles) {
  return angles == Angles::kTuned ? kTuned : kStandard;
}

}  // namespace footwall::extract::lapped
