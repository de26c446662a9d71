// One byte of flags; the runs of nulls, where there are any; then, by the kind of code: nothing or the values
// (kPlain), one value (kConstant), or the step, the offset and the coefficients (kLine, kRaster).
#include "engine/extract/lapped/face_code.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/extract/lapped/band_coder.h"
#include "engine/extract/lapped/raster.h"
#include "engine/extract/statistics/moments.h"
#include "storage/base/error.h"

namespace footwall::extract::lapped {
namespace {

enum class Kind : std::uint8_t { kPlain = 0, kLine = 1, kRaster = 2, kConstant = 3 };
constexpr std::uint32_t kKindMask = 3;
constexpr std::uint32_t kZeroEnds = 1U << 2;
constexpr std::uint32_t kTunedAcross = 1U << 3;
constexpr std::uint32_t kTunedDown = 1U << 4;
constexpr std::uint32_t kHasNulls = 1U << 5;
constexpr std::uint32_t kHasOffset = 1U << 6;

// A face whose picture needs more coefficients than this per voxel (a small or narrow one) takes fewer bytes
// as a line: measured on faces of a faulted survey.
constexpr double kMostCoefficients = 1.35;
// The step is kept in 16 bits: a float32 without its sign and its lower 15 bits.
constexpr int kStepShift = 15;
// A mean closer to 0 than this many standard deviations is left in the values.
constexpr double kLeastOffset = 0.5;
// Many coefficients of smooth values round to 0, with smaller errors than the step promises: it is then made
// coarser, so often at most, until the ratio is met within so much.
constexpr int kMostTrials = 4;
constexpr double kCloseEnough = 0.97;

// 10^(-db / 20), the same on every machine: db in hundredths, by its binary digits.
double attenuation(double db) {
  constexpr std::array<double, 14> kFactors{
      0.9988493699365052, 0.9977000638225533, 0.995405417351527,    0.9908319448927676,   0.9817479430199844,
      0.9638290236239705, 0.9289663867799364, 0.8629785477669702,   0.744731973905989,    0.5546257129579107,
      0.3076096814740708, 0.0946237161365793, 0.008953647655495937, 8.016780633876791e-05};
  const auto hundredths = static_cast<std::uint32_t>(db * 100 + 0.5);
  double product = 1;
  for (std::size_t bit = 0; bit < kFactors.size(); ++bit) {
    if ((hundredths >> bit & 1) != 0) product *= kFactors[bit];
  }
  return product;
}

[[noreturn]] void corrupt(const char* why) {
  throw Error(ErrorCode::kCorrupt, std::string("the code of a face's voxels ") + why,
              "compute the run again: extract --compute lot");
}

template <typename T>
void append(T value, std::vector<std::byte>& out) {
  static_assert(std::endian::native == std::endian::little);
  const auto raw = std::as_bytes(std::span(&value, 1));
  out.insert(out.end(), raw.begin(), raw.end());
}

// Seven bits a byte, the lowest first; the top bit is set where more follow.
void append_number(std::uint32_t number, std::vector<std::byte>& out) {
  for (; number >= 0x80; number >>= 7) out.push_back(static_cast<std::byte>(number | 0x80));
  out.push_back(static_cast<std::byte>(number));
}

// Reads what append() wrote; throws where the bytes end.
class Bytes {
 public:
  explicit Bytes(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::span<const std::byte> rest() const { return bytes_; }
  template <typename T>
  T value() {
    if (bytes_.size() < sizeof(T)) corrupt("ends too early");
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  std::uint32_t number() {
    std::uint32_t number = 0;
    for (std::uint32_t shift = 0; shift < 32; shift += 7) {
      const auto byte = value<std::uint8_t>();
      number |= (byte & 0x7fU) << shift;
      if (byte < 0x80) return number;
    }
    corrupt("has a number without an end");
  }

 private:
  std::span<const std::byte> bytes_;
};

// Blocks of a line of n values.
std::size_t line_size(std::size_t n, Ends ends) {
  if (ends == Ends::kZero) n += 2 * kReach;
  return (n + kBands - 1) / kBands * kBands;
}

float step_from(std::uint16_t bits) {
  return std::bit_cast<float>(std::uint32_t{bits} << kStepShift);
}

// The step in its 16 bits; 0 where it is out of a float's range.
std::uint16_t step_bits(double step) {
  const auto narrow = static_cast<float>(step);
  if (!std::isnormal(narrow)) return 0;
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(narrow) + (1U << (kStepShift - 1))) >>
                                    kStepShift);
}

bool is_step(double step) {
  return std::isnormal(static_cast<float>(step)) && step > 0;
}

// Alternating lengths of runs of values and of nulls, the last one left out.
void append_nulls(std::span<const float> values, std::vector<std::byte>& out) {
  bool null = false;
  std::uint32_t run = 0;
  for (const float value : values) {
    if (std::isfinite(value) == null) {
      append_number(run, out);
      null = !null;
      run = 0;
    }
    ++run;
  }
  append_number(0xffffffff, out);
}

}  // namespace

void validate(const Coding& coding) {
  if (!(coding.snr_db >= kLeastSnr && coding.snr_db <= kMostSnr)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("a signal-to-noise ratio of {} dB cannot be coded", coding.snr_db),
                fmt::format("give {} to {} dB", kLeastSnr, kMostSnr));
  }
}

// What encoder and decoder share: buffers, and the parts of a code in their order.
struct Parts {
  Raster raster;
  std::vector<float> line;  // values or coefficients
  std::vector<float> work;
  std::vector<float> coefficients;
  std::vector<std::int32_t> quantized;
  std::vector<float> picture;
  Details details;
};

struct FaceEncoder::State : Parts {
  explicit State(const Coding& its_coding)
      : coding(its_coding), factor(3.4641016151377544 * attenuation(its_coding.snr_db)) {}
  Coding coding;
  double factor;  // step / standard deviation
  std::vector<float> scaled;
  BandEncoder encoder;

  void scale(std::span<const float> values, double step, double offset);
  void transform_line(std::span<const float> values, Ends ends);
  void transform_raster(const Columns& columns);
  bool quantize(float coarser);
  double mean_square_error(float coarser) const;
  bool encode(const Columns& columns, std::span<const float> values, const Moments& moments,
              std::uint32_t flags, std::size_t start, std::vector<std::byte>& out);
};

namespace {

bool worth_a_picture(const Columns& columns, Raster& raster) {
  if (!raster.lay_out(columns)) return false;
  std::size_t coefficients = raster.tiles().size() * kSquare;
  for (std::size_t n = 0; n < kDetails; ++n) coefficients += raster.details(n);
  return static_cast<double>(coefficients) <= kMostCoefficients * static_cast<double>(columns.voxels);
}

// A mean stands for voxels / means of the values: its coefficients are taken that much finer, by the root, so
// that all errors are alike.
float mean_weight(const Columns& columns, const Raster& raster) {
  return static_cast<float>(
      std::sqrt(static_cast<double>(columns.voxels) / static_cast<double>(raster.means())));
}

}  // namespace

// Nulls take the line between the values around them.
void FaceEncoder::State::scale(std::span<const float> values, double step, double offset) {
  scaled.resize(values.size());
  const double finer = 1 / step;
  for (std::size_t n = 0; n < values.size(); ++n) {
    scaled[n] = static_cast<float>((values[n] - offset) * finer);
  }
  std::size_t last = values.size();
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!std::isfinite(values[n])) continue;
    if (last == values.size()) {
      std::fill_n(scaled.begin(), n, scaled[n]);
    } else if (n > last + 1) {
      const float slope = (scaled[n] - scaled[last]) / static_cast<float>(n - last);
      for (std::size_t gap = last + 1; gap < n; ++gap) {
        scaled[gap] = scaled[last] + slope * static_cast<float>(gap - last);
      }
    }
    last = n;
  }
  if (last < values.size())
    std::fill(scaled.begin() + static_cast<std::ptrdiff_t>(last), scaled.end(), scaled[last]);
}

// Appends the coefficients.
void FaceEncoder::State::transform_line(std::span<const float> values, Ends ends) {
  const std::size_t lead = ends == Ends::kZero ? kReach : 0;
  line.assign(line_size(values.size(), ends), ends == Ends::kZero ? 0 : values.back());
  std::copy(values.begin(), values.end(), line.begin() + static_cast<std::ptrdiff_t>(lead));
  const std::size_t first = coefficients.size();
  coefficients.resize(first + line.size());
  forward(line, coding.across, std::span(coefficients).subspan(first));
}

void FaceEncoder::State::transform_raster(const Columns& columns) {
  raster.spread(columns, scaled, picture, details);
  work.resize(picture.size());
  coefficients.resize(picture.size());
  forward(raster.tiles(), picture, coding.across, coding.down, work, coefficients);
  const float weight = mean_weight(columns, raster);
  for (float& coefficient : coefficients) coefficient *= weight;
  for (const std::vector<float>& detail : details) {
    if (!detail.empty()) transform_line(detail, Ends::kMirrored);
  }
}

// Of the coefficients rounded to multiples of `coarser`, which are in units of the step. Eight sums side by
// side, the same on every processor.
double FaceEncoder::State::mean_square_error(float coarser) const {
  std::array<float, kBands> sums{};
  const float finer = 1 / coarser;
  for (std::size_t n = 0; n < coefficients.size(); n += kBands) {
    for (std::size_t k = 0; k < kBands; ++k) {
      const float value = std::abs(coefficients[n + k]) * finer;
      const float error = value - static_cast<float>(static_cast<std::int32_t>(value + 0.5F));
      sums[k] += error * error;
    }
  }
  double sum = 0;
  for (const float part : sums) sum += part;
  return sum * coarser * coarser / static_cast<double>(coefficients.size());
}

// False where one is too large.
bool FaceEncoder::State::quantize(float coarser) {
  const float finer = 1 / coarser;
  quantized.resize(coefficients.size());
  std::int32_t largest = 0;
  for (std::size_t n = 0; n < coefficients.size(); ++n) {
    const float value = coefficients[n] * finer;
    quantized[n] = static_cast<std::int32_t>(value + (value < 0 ? -0.5F : 0.5F));
    largest = std::max(largest, quantized[n] < 0 ? -quantized[n] : quantized[n]);
  }
  return largest <= static_cast<std::int32_t>(kMostMagnitude);
}

// False where the values cannot be coded, or not in fewer bytes than they have.
bool FaceEncoder::State::encode(const Columns& columns, std::span<const float> values, const Moments& moments,
                                std::uint32_t flags, std::size_t start, std::vector<std::byte>& out) {
  const double deviation = std::sqrt(moments.variance());
  double step = step_from(step_bits(factor * deviation));
  if (!is_step(step)) return false;
  const bool with_offset = std::abs(moments.mean()) > kLeastOffset * deviation;
  const auto offset = static_cast<float>(with_offset ? moments.mean() : 0);
  scale(values, step, offset);
  coefficients.clear();
  const bool as_picture = coding.order == Order::kRaster && worth_a_picture(columns, raster);
  if (as_picture) {
    transform_raster(columns);
  } else {
    transform_line(scaled, coding.ends);
  }
  // A value is at most sqrt(n) deviations off the mean, but the mean itself may dwarf them all.
  const auto fits = [](float value) { return std::abs(value) < static_cast<float>(kMostMagnitude); };
  if (!std::all_of(coefficients.begin(), coefficients.end(), fits)) return false;

  constexpr double kPromised = 1.0 / 12;
  float coarser = 1;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    const double error = mean_square_error(coarser);
    if (error >= kCloseEnough * kPromised || error == 0) break;
    const double wanted = step * coarser * std::sqrt(kPromised / error);
    if (!is_step(step_from(step_bits(wanted)))) break;
    coarser = static_cast<float>(step_from(step_bits(wanted)) / step);
  }
  const std::uint16_t bits = step_bits(step * coarser);
  if (!quantize(static_cast<float>(step_from(bits) / step))) return false;

  flags |= static_cast<std::uint32_t>(as_picture ? Kind::kRaster : Kind::kLine);
  if (with_offset) flags |= kHasOffset;
  if (coding.across == Angles::kTuned) flags |= kTunedAcross;
  if (as_picture && coding.down == Angles::kTuned) flags |= kTunedDown;
  if (!as_picture && coding.ends == Ends::kZero) flags |= kZeroEnds;
  out[start] = static_cast<std::byte>(flags);
  append(bits, out);
  if (with_offset) append(offset, out);
  encoder.clear();
  std::span<const std::int32_t> rest(quantized);
  if (as_picture) {
    encoder.add_tiles(raster.tiles(), rest.first(picture.size()));
    rest = rest.subspan(picture.size());
    for (const std::vector<float>& detail : details) {
      if (detail.empty()) continue;
      const std::size_t size = line_size(detail.size(), Ends::kMirrored);
      encoder.add_line(rest.first(size));
      rest = rest.subspan(size);
    }
  } else {
    encoder.add_line(rest);
  }
  encoder.finish(out);
  return out.size() - start < values.size() * sizeof(float);
}

FaceEncoder::FaceEncoder(const Coding& coding) {
  validate(coding);
  state_ = std::make_unique<State>(coding);
}
FaceEncoder::~FaceEncoder() = default;

void FaceEncoder::encode(const Columns& columns, std::span<const float> values, std::vector<std::byte>& out) {
  require(values.size() == static_cast<std::size_t>(columns.voxels), "a value for every voxel");
  if (values.empty()) return;
  Moments moments;
  fold(values, moments);
  const std::size_t start = out.size();
  std::uint32_t flags = moments.nulls > 0 ? kHasNulls : 0;
  out.push_back(static_cast<std::byte>(flags));
  if (moments.nulls > 0) append_nulls(values, out);
  if (moments.count == 0) return;
  if (moments.min == moments.max) {
    out[start] = static_cast<std::byte>(flags | static_cast<std::uint32_t>(Kind::kConstant));
    append(moments.min, out);
    return;
  }
  const std::size_t body = out.size();
  if (state_->encode(columns, values, moments, flags, start, out)) return;
  out.resize(body);
  out[start] = static_cast<std::byte>(flags);
  for (const float value : values) {
    if (std::isfinite(value)) append(value, out);
  }
}

struct FaceDecoder::State : Parts {
  std::vector<bool> nulls;

  void read_nulls(Bytes& bytes, std::size_t n);
  void read_line(BandDecoder& decoder, Angles angles, Ends ends, std::span<float> values);
  void read_raster(BandDecoder& decoder, const Columns& columns, Angles across, Angles down,
                   std::span<float> values);
};

void FaceDecoder::State::read_nulls(Bytes& bytes, std::size_t n) {
  nulls.assign(n, false);
  bool null = false;
  for (std::size_t at = 0; at < n; null = !null) {
    const std::uint32_t run = bytes.number();
    const std::size_t end = run == 0xffffffff ? n : at + run;
    if (end > n || (run == 0 && at > 0)) corrupt("has nulls where there are no voxels");
    if (null)
      std::fill(nulls.begin() + static_cast<std::ptrdiff_t>(at),
                nulls.begin() + static_cast<std::ptrdiff_t>(end), true);
    at = end;
  }
}

void FaceDecoder::State::read_line(BandDecoder& decoder, Angles angles, Ends ends, std::span<float> values) {
  quantized.resize(line_size(values.size(), ends));
  decoder.read_line(quantized);
  coefficients.assign(quantized.begin(), quantized.end());
  line.resize(quantized.size());
  inverse(coefficients, angles, line);
  std::copy_n(line.begin() + (ends == Ends::kZero ? kReach : 0), values.size(), values.begin());
}

void FaceDecoder::State::read_raster(BandDecoder& decoder, const Columns& columns, Angles across, Angles down,
                                     std::span<float> values) {
  if (!raster.lay_out(columns) || raster.means() == 0) corrupt("is of another face");
  quantized.resize(raster.tiles().size() * kSquare);
  decoder.read_tiles(raster.tiles(), quantized);
  const float weight = mean_weight(columns, raster);
  coefficients.resize(quantized.size());
  for (std::size_t n = 0; n < quantized.size(); ++n)
    coefficients[n] = static_cast<float>(quantized[n]) / weight;
  work.resize(quantized.size());
  picture.resize(quantized.size());
  inverse(raster.tiles(), coefficients, across, down, work, picture);
  for (std::size_t n = 0; n < kDetails; ++n) {
    details[n].resize(raster.details(n));
    if (!details[n].empty()) read_line(decoder, across, Ends::kMirrored, details[n]);
  }
  raster.collect(columns, picture, details, values);
}

FaceDecoder::FaceDecoder() : state_(std::make_unique<State>()) {}
FaceDecoder::~FaceDecoder() = default;

void FaceDecoder::decode(std::span<const std::byte> code, const Columns& columns, std::span<float> values) {
  require(values.size() == static_cast<std::size_t>(columns.voxels), "a value for every voxel");
  if (values.empty()) {
    if (!code.empty()) corrupt("is of another face");
    return;
  }
  Bytes bytes(code);
  const std::uint32_t flags = bytes.value<std::uint8_t>();
  state_->nulls.assign(values.size(), false);
  if ((flags & kHasNulls) != 0) state_->read_nulls(bytes, values.size());
  const auto is_null = [&](std::size_t n) { return state_->nulls[n]; };
  const Angles across = (flags & kTunedAcross) != 0 ? Angles::kTuned : Angles::kStandard;
  const Angles down = (flags & kTunedDown) != 0 ? Angles::kTuned : Angles::kStandard;
  const Kind kind{static_cast<std::uint8_t>(flags & kKindMask)};
  switch (kind) {
    case Kind::kPlain:
      for (std::size_t n = 0; n < values.size(); ++n) {
        if (!is_null(n)) values[n] = bytes.value<float>();
      }
      break;
    case Kind::kConstant:
      std::fill(values.begin(), values.end(), bytes.value<float>());
      break;
    case Kind::kLine:
    case Kind::kRaster: {
      const double step = step_from(bytes.value<std::uint16_t>());
      if (!is_step(step)) corrupt("has no step");
      const double offset = (flags & kHasOffset) != 0 ? bytes.value<float>() : 0;
      BandDecoder decoder(bytes.rest());
      if (kind == Kind::kRaster) {
        state_->read_raster(decoder, columns, across, down, values);
      } else {
        state_->read_line(decoder, across, (flags & kZeroEnds) != 0 ? Ends::kZero : Ends::kMirrored, values);
      }
      decoder.end();
      for (float& value : values) value = static_cast<float>(value * step + offset);
      break;
    }
  }
  if (kind < Kind::kLine || kind == Kind::kConstant) {
    if (!bytes.rest().empty()) corrupt("has bytes to spare");
  }
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (is_null(n)) values[n] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace footwall::extract::lapped
