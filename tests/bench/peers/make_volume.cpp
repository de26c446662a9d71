// The volumes that isosurfaces are compared on, as raw float32: make_volume KIND N FILE, N^3 samples.
//
//   sphere    0.4 N minus the distance from the middle; isovalue 0
//   envelope  the envelope of a sum of wavelets of random dip, seismic in its spectrum; isovalue 0.71
//   gyroid    8.38 periods along each axis; isovalue 0
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

namespace {

using Row = std::vector<float>;
constexpr double kTurn = 2 * std::numbers::pi;

class Sphere {
 public:
  explicit Sphere(int n) : middle_((n - 1) / 2.0), radius_(0.4 * n) {}
  void row(int i, int j, Row& into) const {
    for (std::size_t k = 0; k < into.size(); ++k) {
      into[k] = static_cast<float>(radius_ -
                                   std::hypot(i - middle_, j - middle_, static_cast<double>(k) - middle_));
    }
  }

 private:
  double middle_;
  double radius_;
};

class Gyroid {
 public:
  explicit Gyroid(int n) : angle_(kTurn * 8.38 / n) {}
  void row(int i, int j, Row& into) const {
    const double x = i * angle_;
    const double y = j * angle_;
    for (std::size_t k = 0; k < into.size(); ++k) {
      const double z = static_cast<double>(k) * angle_;
      into[k] = static_cast<float>(std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) +
                                   std::sin(z) * std::cos(x));
    }
  }

 private:
  double angle_;
};

// |sum of exp(2 pi i (f . x + phase))| over frequencies that lie in a band along k and are low on the other
// axes; the mean square is 1.
class Envelope {
 public:
  explicit Envelope(int n) {
    std::mt19937 random(20);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    for (int wave = 0; wave < kWaves; ++wave) {
      const double f[3] = {between(-0.011, 0.011), between(-0.011, 0.011), between(0.02, 0.055)};
      const double phase = between(0, 1);
      for (int axis = 0; axis < 3; ++axis) {
        auto& factors = factors_[axis].emplace_back();
        for (int at = 0; at < n; ++at) {
          const double turns = f[axis] * at + (axis == 0 ? phase : 0);
          factors.emplace_back(std::polar(1.0F, static_cast<float>(kTurn * (turns - std::floor(turns)))));
        }
      }
    }
  }
  void row(int i, int j, Row& into) const {
    std::vector<std::complex<float>> sum(into.size());
    for (std::size_t wave = 0; wave < kWaves; ++wave) {
      const std::complex<float> start =
          factors_[0][wave][static_cast<std::size_t>(i)] * factors_[1][wave][static_cast<std::size_t>(j)];
      for (std::size_t k = 0; k < into.size(); ++k) {
        const std::complex<float> b = factors_[2][wave][k];
        sum[k] += std::complex<float>(start.real() * b.real() - start.imag() * b.imag(),
                                      start.real() * b.imag() + start.imag() * b.real());
      }
    }
    for (std::size_t k = 0; k < into.size(); ++k)
      into[k] = std::abs(sum[k]) / std::sqrt(static_cast<float>(kWaves));
  }

 private:
  static constexpr int kWaves = 24;
  std::vector<std::vector<std::complex<float>>> factors_[3];
};

template <class Shape>
void write(const Shape& shape, int n, const char* path) {
  std::FILE* const file = std::fopen(path, "wb");
  bool good = file != nullptr;
  Row row(static_cast<std::size_t>(n));
  for (int i = 0; good && i < n; ++i) {
    for (int j = 0; good && j < n; ++j) {
      shape.row(i, j, row);
      good = std::fwrite(row.data(), sizeof(float), row.size(), file) == row.size();
    }
  }
  if (file != nullptr && std::fclose(file) != 0) good = false;
  if (good) return;
  fmt::print(stderr, "cannot write {}: {}\n", path, std::strerror(errno));
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc == 4 ? argv[1] : "";
  const int n = argc == 4 ? std::atoi(argv[2]) : 0;
  if (n < 2 || (kind != "sphere" && kind != "envelope" && kind != "gyroid")) {
    fmt::print(stderr, "usage: make_volume sphere|envelope|gyroid N FILE\n");
    return 2;
  }
  if (kind == "sphere") write(Sphere(n), n, argv[3]);
  if (kind == "envelope") write(Envelope(n), n, argv[3]);
  if (kind == "gyroid") write(Gyroid(n), n, argv[3]);
}
