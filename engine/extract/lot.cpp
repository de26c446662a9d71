#include "engine/extract/lot.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/extract/choice.h"
#include "engine/extract/computations.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::string_view kLot = "lot";  // coded; all others are float32, as `voxels`

// The angles along a row and down the columns of a face.
lapped::Coding along_samples(const LotCoding& lot, const FaceRows& rows) {
  lapped::Coding coding = lot.coding;
  if (!lot.tuned || rows.rows() == 0) return coding;
  const voxelize::Row first = rows.at(0);
  constexpr int kSampleAxis = 2;
  if (first.u_axis == kSampleAxis || coding.order == lapped::Order::kLine) {
    coding.across = lapped::Angles::kTuned;
  }
  if (first.v_axis == kSampleAxis) coding.down = lapped::Angles::kTuned;
  return coding;
}

class Lot final : public WholeFace {
 public:
  explicit Lot(const LotCoding& lot) : lot_(lot) {}

  void compute(const FaceVoxels& face, std::vector<std::byte>& out) override {
    columns_of(face.rows, columns_);
    const lapped::Coding coding = along_samples(lot_, face.rows);
    if (!encoder_ || !(coding == used_)) {
      encoder_ = std::make_unique<lapped::FaceEncoder>(coding);
      used_ = coding;
    }
    encoder_->encode(columns_, face.values, out);
  }

 private:
  LotCoding lot_;
  lapped::Coding used_;
  std::unique_ptr<lapped::FaceEncoder> encoder_;
  lapped::Columns columns_;
};

class TransformAlone final : public WholeFace {
 public:
  explicit TransformAlone(lapped::Angles angles) : angles_(angles) {}

  void compute(const FaceVoxels& face, std::vector<std::byte>& out) override {
    static_cast<void>(out);
    if (face.values.empty()) return;
    constexpr std::size_t kBlock = lapped::kBands;
    line_.resize((face.values.size() + kBlock - 1) / kBlock * kBlock);
    std::transform(face.values.begin(), face.values.end(), line_.begin(),
                   [](float value) { return std::isfinite(value) ? value : 0.0F; });
    std::fill(line_.begin() + static_cast<std::ptrdiff_t>(face.values.size()), line_.end(), 0.0F);
    coefficients_.resize(line_.size());
    lapped::forward(line_, angles_, coefficients_);
    // In double: a float's range squared fits.
    constexpr double kRounding = 1e-5;
    const double before = energy(line_);
    const double after = energy(coefficients_);
    require(!(std::abs(after - before) > kRounding * before), "coefficients with the energy of the values");
  }

 private:
  static double energy(std::span<const float> values) {
    // Several sums, so that they can be added side by side; this one decides nothing that is stored.
    std::array<double, lapped::kBands> sums{};
    for (std::size_t n = 0; n < values.size(); n += sums.size()) {
      for (std::size_t k = 0; k < sums.size(); ++k) {
        sums[k] += static_cast<double>(values[n + k]) * values[n + k];
      }
    }
    double sum = 0;
    for (const double part : sums) sum += part;
    return sum;
  }

  lapped::Angles angles_;
  std::vector<float> line_;
  std::vector<float> coefficients_;
};

class Values final : public WholeFace {
 public:
  void compute(const FaceVoxels& face, std::vector<std::byte>& out) override {
    static_assert(std::endian::native == std::endian::little);
    values_.assign(face.values.begin(), face.values.end());
    for (float& value : values_) {
      if (!std::isfinite(value)) value = std::numeric_limits<float>::quiet_NaN();
    }
    const auto bytes = std::as_bytes(std::span(values_));
    out.insert(out.end(), bytes.begin(), bytes.end());
  }

 private:
  std::vector<float> values_;
};

}  // namespace

LotCoding lot_coding(const Options& options) {
  const Choice choice = parse_choice(options.lot_order);
  const Error unknown(ErrorCode::kUsage, "there is no lot order '" + options.lot_order + "'",
                      "choose one of: 2d, 2d=tuned, 1d, 1d=zero, 1d=tuned, 1d=zero,tuned");
  LotCoding lot;
  if (choice.name == "1d") {
    lot.coding.order = lapped::Order::kLine;
  } else if (choice.name != "2d") {
    throw unknown;
  }
  for (const std::string& parameter : choice.parameters) {
    if (parameter == "tuned") {
      lot.tuned = true;
    } else if (parameter == "zero" && choice.name == "1d") {
      lot.coding.ends = lapped::Ends::kZero;
    } else {
      throw unknown;
    }
  }
  if (options.snr != 0) {
    lot.coding.snr_db = options.snr;
    lapped::validate(lot.coding);
  }
  return lot;
}

void columns_of(const FaceRows& rows, lapped::Columns& columns) {
  columns.clear();
  for (std::size_t n = 0; n < rows.rows(); ++n) {
    const voxelize::Row row = rows.at(n);
    const voxelize::Row first = rows.at(0);
    bool ordered = row.u_axis == first.u_axis && row.v_axis == first.v_axis;
    if (!columns.rows.empty()) {
      const lapped::ColumnRow& last = columns.rows.back();
      const std::int64_t behind = last.u + static_cast<std::int64_t>(last.count);
      ordered = ordered && (row.v > last.v || (row.v == last.v && row.u0 >= behind));
    }
    if (!ordered) {
      columns.clear();
      columns.add(0, 0, static_cast<std::int32_t>(rows.voxels()));
      return;
    }
    for (std::size_t c = 0; c < row.lo.size(); ++c) {
      columns.add(row.u0 + static_cast<std::int64_t>(c), row.v, std::max(0, row.hi[c] - row.lo[c] + 1));
    }
  }
}

bool holds_voxels(std::string_view computation) {
  const auto rows = computations();
  return std::any_of(rows.begin(), rows.end(),
                     [&](const Computation& row) { return row.holds_voxels && row.name == computation; });
}

VoxelReader::VoxelReader(std::string_view computation) : coded_(computation == kLot) {
  if (holds_voxels(computation)) return;
  throw Error(ErrorCode::kUnsupported,
              "'" + std::string(computation) + "' holds no voxels that can be read back",
              "was the run made by a newer footwall?");
}

void VoxelReader::read(std::span<const std::byte> bytes, const FaceRows& rows, std::vector<float>& values) {
  values.resize(static_cast<std::size_t>(rows.voxels()));
  if (coded_) {
    columns_of(rows, columns_);
    decoder_.decode(bytes, columns_, values);
    return;
  }
  if (bytes.size() != values.size() * sizeof(float)) {
    throw Error(ErrorCode::kCorrupt, "the voxels of a face are not as many as it has",
                "compute the run again: extract --compute voxels");
  }
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
}

std::unique_ptr<WholeFace> make_lot(const Options& options) {
  const LotCoding lot = lot_coding(options);
  if (options.snr != 0) return std::make_unique<Lot>(lot);
  return std::make_unique<TransformAlone>(lot.tuned ? lapped::Angles::kTuned : lapped::Angles::kStandard);
}

std::unique_ptr<WholeFace> make_voxels(const Options& options) {
  static_cast<void>(options);
  return std::make_unique<Values>();
}

}  // namespace footwall::extract
