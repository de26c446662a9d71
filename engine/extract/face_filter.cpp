#include "engine/extract/face_filter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/extract/choice.h"
#include "engine/extract/spectrum.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr double kLongest = 4096;                          // voxels
constexpr double kHalfAmplitude = 0.18920711500272106672;  // 2^(1/4) - 1
constexpr float kNull = std::numeric_limits<float>::quiet_NaN();

struct Band {
  double first = 1;   // factor of L_shorter (of the raster itself where shorter is 0)
  double second = 0;  // factor of L_longer
  double shorter = 0;
  double longer = 0;
  double own = 0;  // factor of the voxel's own value
};

Band band_of(const std::string& text) {
  const Choice choice = parse_choice(text);
  choice.takes_at_most(2);
  if (choice.name == "band") {
    const double shorter = choice.number(0, "the shortest wavelength", 4, 0, kLongest);
    const double longer = choice.number(1, "the longest wavelength", 32, 2, kLongest);
    if (longer <= shorter || (shorter != 0 && shorter < 2)) {
      throw Error(ErrorCode::kUsage, "'" + text + "' is no band",
                  "give a shorter wavelength of 0 or at least 2 voxels and a longer one: band=4,32");
    }
    return {1, -1, shorter, longer, 0};
  }
  if (choice.name == "sharpen") {
    const double amount = choice.number(0, "the amount", 1, 0, 100);
    return {amount, -amount, 0, choice.number(1, "the wavelength", 8, 2, kLongest), 1};
  }
  throw Error(ErrorCode::kUsage, "there is no filter '" + text + "'",
              "give band=SHORT,LONG or sharpen=AMOUNT,LENGTH, with wavelengths in voxels");
}

// The columns of a face as a picture.
struct Raster {
  std::int64_t u0 = 0, v0 = 0;
  std::int64_t width = 0, height = 0;
  std::vector<double> value;  // [v][u], 0 where masked
  std::vector<double> mask;   // 1 where a column has a value, else 0

  void lay_out(const FaceRows& rows);
  std::size_t cell(std::int64_t u, std::int64_t v) const {
    return static_cast<std::size_t>((v - v0) * width + u - u0);
  }
};

void Raster::lay_out(const FaceRows& rows) {
  std::int64_t u1 = std::numeric_limits<std::int64_t>::min();
  std::int64_t v1 = u1;
  u0 = v0 = std::numeric_limits<std::int64_t>::max();
  for (std::size_t n = 0; n < rows.rows(); ++n) {
    const voxelize::Row row = rows.at(n);
    u0 = std::min(u0, row.u0);
    v0 = std::min(v0, row.v);
    u1 = std::max(u1, row.u0 + static_cast<std::int64_t>(row.lo.size()));
    v1 = std::max(v1, row.v + 1);
  }
  width = u1 - u0;
  height = v1 - v0;
  value.assign(static_cast<std::size_t>(width * height), 0);
  mask.assign(value.size(), 0);
}

// visit(u, v, first, count): each column that has voxels, whose values are [first, first + count).
template <typename Visit>
void for_each_column(const FaceRows& rows, Visit&& visit) {
  std::size_t next = 0;
  for (std::size_t n = 0; n < rows.rows(); ++n) {
    const voxelize::Row row = rows.at(n);
    for (std::size_t c = 0; c < row.lo.size(); ++c) {
      if (row.hi[c] < row.lo[c]) continue;
      const auto count = static_cast<std::size_t>(row.hi[c] - row.lo[c] + 1);
      visit(row.u0 + static_cast<std::int64_t>(c), row.v, next, count);
      next += count;
    }
  }
}

class FaceFilter final : public WholeFace {
 public:
  explicit FaceFilter(const Band& band) : band_(band) {}

  void compute(const FaceVoxels& face, std::vector<std::byte>& out) override {
    if (face.rows.voxels() == 0) return;
    fill(face);
    combined_ = raster_.value;
    for (double& value : combined_) value *= band_.shorter == 0 ? band_.first : 0;
    spectrum_.take(raster_.value, raster_.mask, raster_.width, raster_.height,
                   static_cast<std::int64_t>(std::ceil(std::max(band_.longer, band_.shorter))));
    if (band_.shorter != 0) add(band_.first, band_.shorter);
    add(band_.second, band_.longer);
    write(face, out);
  }

 private:
  void fill(const FaceVoxels& face) {
    raster_.lay_out(face.rows);
    for_each_column(face.rows, [&](std::int64_t u, std::int64_t v, std::size_t first, std::size_t count) {
      double sum = 0;
      int finite = 0;
      for (const float value : face.values.subspan(first, count)) {
        if (!std::isfinite(value)) continue;
        sum += value;
        ++finite;
      }
      if (finite == 0) return;
      const std::size_t cell = raster_.cell(u, v);
      raster_.value[cell] = sum / finite;
      raster_.mask[cell] = 1;
    });
  }

  void add(double factor, double wavelength) {
    spectrum_.low_pass(
        [&](double squared_frequency) {
          const double base = 1 + kHalfAmplitude * squared_frequency * wavelength * wavelength;
          return 1 / (base * base * base * base);
        },
        low_value_, low_mask_);
    for (std::size_t cell = 0; cell < combined_.size(); ++cell) {
      if (raster_.mask[cell] != 0) combined_[cell] += factor * low_value_[cell] / low_mask_[cell];
    }
  }

  void write(const FaceVoxels& face, std::vector<std::byte>& out) const {
    double largest = 0;
    for (const float value : face.values) {
      if (std::isfinite(value)) largest = std::max(largest, std::abs(static_cast<double>(value)));
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    constexpr int kKeptBits = 22;
    const std::size_t start = out.size();
    out.resize(start + face.values.size() * sizeof(float));
    for_each_column(face.rows, [&](std::int64_t u, std::int64_t v, std::size_t first, std::size_t count) {
      const double filtered = combined_[raster_.cell(u, v)];
      for (std::size_t n = first; n < first + count; ++n) {
        const float own = face.values[n];
        const double result = filtered + band_.own * own;
        const double kept =
            std::ldexp(std::nearbyint(std::ldexp(result, kKeptBits - exponent)), exponent - kKeptBits);
        const float value = std::isfinite(own) ? static_cast<float>(kept) : kNull;
        std::memcpy(out.data() + start + n * sizeof(float), &value, sizeof(float));
      }
    });
  }

  Band band_;
  Raster raster_;
  Spectrum spectrum_;
  std::vector<double> combined_, low_value_, low_mask_;
};

}  // namespace

std::unique_ptr<WholeFace> make_face_filter(const Options& options) {
  return std::make_unique<FaceFilter>(band_of(options.filter));
}

}  // namespace footwall::extract
