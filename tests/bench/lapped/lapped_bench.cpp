// The coding of faces' voxels: bits a voxel, the ratio reached, and voxels a second on one core, for the line
// and the picture at several sizes of triangles. Reconstruction is checked before the clock starts. Times are
// processor times, so that a busy machine does not spoil them.
//
//   bench_lapped [SNR_DB] [SECONDS]     default 30, 0.2
//
// The figures to reach, at a step of 0.1 standard deviations and with the ideal entropy: 4.68 / 4.46 / 4.34 /
// 4.24 bits a voxel for lines and 4.24 / 3.67 / 3.16 / 2.68 for pictures of autoregressive triangles of sides
// 24 / 48 / 96 / 300; 300 M voxels/s for the transform and 100 M with the entropy coding.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "engine/extract/lapped/face_code.h"
#include "engine/synthetic/faulted.h"
#include "engine/voxelize/registry.h"
#include "engine/voxelize/simd.h"

namespace {

using namespace footwall;
using namespace footwall::extract::lapped;

struct MadeFace {
  Columns columns;
  std::vector<float> values;
};

struct Set {
  std::string name;
  std::vector<MadeFace> faces;
};

// A field that is AR(1) with 0.98 across and AR(2) with a pole of radius 0.95 at 0.12 cycles a sample down,
// with 3 % white noise.
class Field {
 public:
  static constexpr std::size_t kSide = 512;
  Field() : values_(kSide * kSide) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (double& value : values_) value = normal(random);
    for (std::size_t y = 0; y < kSide; ++y) {
      for (std::size_t x = 1; x < kSide; ++x)
        at(x, y) = 0.98 * at(x - 1, y) + std::sqrt(1 - 0.98 * 0.98) * at(x, y);
    }
    const double a1 = 2 * 0.95 * std::cos(2 * std::acos(-1.0) * 0.12);
    for (std::size_t y = 2; y < kSide; ++y) {
      for (std::size_t x = 0; x < kSide; ++x) at(x, y) += a1 * at(x, y - 1) - 0.95 * 0.95 * at(x, y - 2);
    }
    double energy = 0;
    for (const double value : values_) energy += value * value;
    const double rms = std::sqrt(energy / static_cast<double>(values_.size()));
    for (double& value : values_) value = value / rms + 0.03 * normal(random);
  }
  double& at(std::size_t x, std::size_t y) { return values_[y * kSide + x]; }

 private:
  std::vector<double> values_;
};

// Right triangles, one voxel a column; u runs down.
Set autoregressive(Field& field, std::size_t side, std::size_t count) {
  Set set{fmt::format("autoregressive, side {}", side), {}};
  std::mt19937 random(4);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t x0 = random() % (Field::kSide - side);
    const std::size_t y0 = random() % (Field::kSide - side);
    MadeFace face;
    for (std::size_t x = 0; x < side; ++x) {
      for (std::size_t y = 0; y < side - x; ++y) {
        face.columns.add(static_cast<std::int64_t>(y), static_cast<std::int64_t>(x), 1);
        face.values.push_back(static_cast<float>(field.at(x0 + x, y0 + y)));
      }
    }
    set.faces.push_back(std::move(face));
  }
  return set;
}

using ValueAt = std::function<float(const survey::Index&)>;

class Collector final : public voxelize::RowSink {
 public:
  Collector(MadeFace& face, const ValueAt& value) : face_(face), value_(value) {}
  void row(const voxelize::Row& row) override {
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      const std::int64_t u = row.u0 + static_cast<std::int64_t>(n);
      face_.columns.add(u, row.v, std::max(0, row.hi[n] - row.lo[n] + 1));
      for (std::int32_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        survey::Index voxel{};
        voxel[static_cast<std::size_t>(row.u_axis)] = u;
        voxel[static_cast<std::size_t>(row.v_axis)] = row.v;
        voxel[static_cast<std::size_t>(row.w_axis)] = w;
        face_.values.push_back(value_(voxel));
      }
    }
  }

 private:
  MadeFace& face_;
  const ValueAt& value_;
};

// Right triangles of a leg, dipping 50 to 85 degrees, somewhere in the box.
Set dipping(const std::string& name, const survey::Index& dims, const ValueAt& value, double leg,
            std::size_t count) {
  Set set{fmt::format("{}, leg {}", name, leg), {}};
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967296.0);
  };
  const std::unique_ptr<voxelize::Voxelizer> voxelizer = voxelize::make_voxelizer("exact");
  while (set.faces.size() < count) {
    const double strike = between(0, 2 * std::acos(-1.0));
    const double dip = between(50, 85) * std::acos(-1.0) / 180;
    const std::array<double, 3> along{std::cos(strike), std::sin(strike), 0};
    const std::array<double, 3> down{-std::sin(strike) * std::cos(dip), std::cos(strike) * std::cos(dip),
                                     std::sin(dip)};
    std::array<std::array<double, 3>, 3> corners{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = between(0, static_cast<double>(dims[axis]) - 1);
      corners[0][axis] = from;
      corners[1][axis] = from + leg * along[axis];
      corners[2][axis] = from + leg * down[axis];
    }
    survey::LatticeTriangle triangle;
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        inside = inside && corners[c][axis] >= 0 && corners[c][axis] <= static_cast<double>(dims[axis]) - 1;
      }
      const auto lattice = [&](std::size_t axis) {
        return static_cast<std::int32_t>(corners[c][axis] * survey::kLatticePerVoxel);
      };
      triangle[c] = {lattice(0), lattice(1), lattice(2)};
    }
    if (!inside) continue;
    MadeFace face;
    Collector collector(face, value);
    voxelizer->rows(triangle, {{0, 0, 0}, dims}, collector);
    set.faces.push_back(std::move(face));
  }
  return set;
}

double seconds_of(double at_least, const std::function<void()>& work) {
  int rounds = 0;
  const std::clock_t start = std::clock();
  std::clock_t now = start;
  do {
    work();
    ++rounds;
    now = std::clock();
  } while (static_cast<double>(now - start) < at_least * CLOCKS_PER_SEC);
  return static_cast<double>(now - start) / CLOCKS_PER_SEC / rounds;
}

struct Figures {
  double bits = 0;  // a voxel
  double snr = 0;
  double encode = 0;  // M voxels/s
  double decode = 0;
};

Figures measure(const Set& set, const Coding& coding, double at_least) {
  FaceEncoder encoder(coding);
  FaceDecoder decoder;
  double voxels = 0;
  double bytes = 0;
  double signal = 0;
  double noise = 0;
  std::vector<std::vector<std::byte>> codes;
  std::vector<float> back;
  for (const MadeFace& face : set.faces) {
    std::vector<std::byte>& code = codes.emplace_back();
    encoder.encode(face.columns, face.values, code);
    back.assign(face.values.size(), 0);
    decoder.decode(code, face.columns, back);
    double mean = 0;
    for (const float value : face.values) mean += value;
    mean /= static_cast<double>(face.values.size());
    double own = 0;
    double error = 0;
    for (std::size_t n = 0; n < back.size(); ++n) {
      own += (face.values[n] - mean) * (face.values[n] - mean);
      error += (face.values[n] - back[n]) * (face.values[n] - back[n]);
    }
    if (!(10 * std::log10(own / error) > coding.snr_db - 3)) {
      fmt::print(stderr, "a face came back with {} dB\n", 10 * std::log10(own / error));
      std::exit(1);
    }
    signal += own;
    noise += error;
    voxels += static_cast<double>(face.values.size());
    bytes += static_cast<double>(code.size());
  }
  Figures figures;
  figures.bits = 8 * bytes / voxels;
  figures.snr = 10 * std::log10(signal / noise);
  std::vector<std::byte> out;
  const double encode = seconds_of(at_least, [&] {
    for (const MadeFace& face : set.faces) {
      out.clear();
      encoder.encode(face.columns, face.values, out);
    }
  });
  const double decode = seconds_of(at_least, [&] {
    for (std::size_t n = 0; n < codes.size(); ++n) {
      back.resize(set.faces[n].values.size());
      decoder.decode(codes[n], set.faces[n].columns, back);
    }
  });
  figures.encode = voxels / encode / 1e6;
  figures.decode = voxels / decode / 1e6;
  return figures;
}

void transform_alone(double at_least) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  constexpr std::size_t kWide = 24;
  std::vector<Tile> tiles(kWide * kWide);
  for (std::uint32_t n = 0; n < tiles.size(); ++n) {
    if (n % kWide > 0) tiles[n].left = n - 1;
    if (n % kWide + 1 < kWide) tiles[n].right = n + 1;
    if (n >= kWide) tiles[n].above = n - kWide;
    if (n + kWide < tiles.size()) tiles[n].below = n + kWide;
  }
  std::vector<float> values(tiles.size() * kSquare);
  for (float& value : values) value = normal(random);
  std::vector<float> work(values.size());
  std::vector<float> coefficients(values.size());
  const double line = seconds_of(at_least, [&] { forward(values, Angles::kStandard, coefficients); });
  const double field = seconds_of(
      at_least, [&] { forward(tiles, values, Angles::kStandard, Angles::kStandard, work, coefficients); });
  fmt::print("transform alone, M values/s ({}): line {:.0f}, picture {:.0f}\n", voxelize::simd_in_use(),
             static_cast<double>(values.size()) / line / 1e6,
             static_cast<double>(values.size()) / field / 1e6);
}

}  // namespace

int main(int argc, char** argv) {
  const double snr = argc > 1 ? std::atof(argv[1]) : 30;
  const double at_least = argc > 2 ? std::atof(argv[2]) : 0.2;
  transform_alone(at_least);

  std::vector<Set> sets;
  Field field;
  for (const auto& [side, count] :
       std::map<std::size_t, std::size_t>{{24, 200}, {48, 100}, {96, 40}, {300, 6}}) {
    sets.push_back(autoregressive(field, side, count));
  }
  synthetic::Options options;
  options.size = {192, 192, 256};
  const synthetic::FaultedSurvey survey(options);
  const survey::Index dims = options.size;
  std::vector<float> volume(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
  survey.fill({{0, 0, 0}, dims}, volume);
  const ValueAt amplitude = [&](const survey::Index& p) {
    return volume[static_cast<std::size_t>((p[0] * dims[1] + p[1]) * dims[2] + p[2])];
  };
  std::mt19937 random(11);
  std::vector<float> white(volume.size());
  for (float& value : white) value = static_cast<float>(random() / 4294967296.0);
  const ValueAt hash = [&](const survey::Index& p) {
    return white[static_cast<std::size_t>((p[0] * dims[1] + p[1]) * dims[2] + p[2])];
  };
  for (const double leg : {24.0, 48.0, 96.0}) {
    sets.push_back(dipping("synthetic survey", dims, amplitude, leg, leg > 60 ? 40 : 100));
  }
  sets.push_back(dipping("random numbers", dims, hash, 45, 100));

  fmt::print("\n{:<28} {:>7} {:>8} | {:>6} {:>6} {:>7} {:>7} | {:>6} {:>6} {:>7} {:>7} | {:>6}\n", "faces",
             "voxels", "a face", "line", "dB", "code", "back", "pict.", "dB", "code", "back", "ratio");
  for (const Set& set : sets) {
    const Figures line = measure(set, {snr, Order::kLine}, at_least);
    const Figures picture = measure(set, {snr, Order::kRaster}, at_least);
    std::size_t voxels = 0;
    for (const MadeFace& face : set.faces) voxels += face.values.size();
    fmt::print(
        "{:<28} {:>7} {:>8} | {:>6.3f} {:>6.2f} {:>7.1f} {:>7.1f} | {:>6.3f} {:>6.2f} {:>7.1f} {:>7.1f} | "
        "{:>6.3f}\n",
        set.name, voxels, voxels / set.faces.size(), line.bits, line.snr, line.encode, line.decode,
        picture.bits, picture.snr, picture.encode, picture.decode, picture.bits / line.bits);
  }
  fmt::print("line, pict.: bits a voxel, all bytes counted; code, back: M voxels/s, one core\n");
  return 0;
}
