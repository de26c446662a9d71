// The discontinuities of a face and of its copies along the normal (probes.h), and what follows from them.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace footwall::extract {

inline constexpr int kContrastShift = 6;  // voxels
inline constexpr int kFarthestShift = 8;  // voxels
inline constexpr std::int64_t kLeastSamples = 30;

class Profile {
 public:
  Profile() { values_.fill(std::numeric_limits<double>::quiet_NaN()); }

  // shift: -8..8. A face with fewer than 30 samples there stays null, as does a NaN.
  void set(int shift, std::int64_t samples, double discontinuity) {
    if (samples >= kLeastSamples) values_[place(shift)] = discontinuity;
  }
  double at(int shift) const { return values_[place(shift)]; }

  // own: the face's discontinuity, whatever its number of samples. NaN where a probe at +-6 is null.
  double contrast(double own) const { return own - (at(-kContrastShift) + at(kContrastShift)) / 2; }

  struct Peak {
    double shift = std::numeric_limits<double>::quiet_NaN();
    double score = std::numeric_limits<double>::quiet_NaN();
  };
  // The highest discontinuity; of equally high ones the nearest, of two equally near the positive one. NaN
  // where all are null.
  Peak peak() const {
    Peak best;
    for (int distance = 0; distance <= kFarthestShift; ++distance) {
      for (const int shift : {distance, -distance}) {
        const double value = at(shift);
        if (std::isnan(value) || value <= best.score) continue;
        best = {static_cast<double>(shift), value};
      }
    }
    return best;
  }

 private:
  static std::size_t place(int shift) { return static_cast<std::size_t>(shift + kFarthestShift); }
  std::array<double, 2 * kFarthestShift + 1> values_{};
};

}  // namespace footwall::extract
