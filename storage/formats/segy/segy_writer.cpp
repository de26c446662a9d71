// Based on: SEG Technical Standards, SEG-Y revisions 1 and 2.0.
#include "storage/formats/segy/segy_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/segy/segy_words.h"

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kMostSamples = std::int64_t{32} << 20;  // of a slab that is read at once
constexpr std::int64_t kMostPlainSamples = 65535;

struct Positions {
  int scalar = 1;  // as at byte 71
  double factor = 1;
};

// The finest decimal step in which every coordinate of the survey fits 32 bits.
Positions choose_positions(const survey::Geometry& geometry, std::vector<std::string>& notes) {
  double largest = 0;
  const auto i_end = static_cast<double>(geometry.inlines.count - 1);
  const auto j_end = static_cast<double>(geometry.crosslines.count - 1);
  for (const double i : {0.0, i_end}) {
    for (const double j : {0.0, j_end}) {
      const survey::WorldPoint p = geometry.world_of({i, j, 0});
      largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    }
  }
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  const std::string unit = geometry.horizontal_unit;
  for (const int divisor : {1000, 100, 10, 1}) {
    if (largest * divisor > kMost - 1) continue;
    if (divisor < 1000) {
      notes.push_back(fmt::format("coordinates up to {:.0f} {} leave steps of {} {}: 32 bits hold no more",
                                  largest, unit, 1.0 / divisor, unit));
    }
    return {divisor == 1 ? 1 : -divisor, static_cast<double>(divisor)};
  }
  for (const int multiplier : {10, 100, 1000, 10000}) {
    if (largest / multiplier > kMost - 1) continue;
    notes.push_back(fmt::format("coordinates up to {:g} leave steps of {} {}", largest, multiplier, unit));
    return {multiplier, 1.0 / multiplier};
  }
  throw Error(ErrorCode::kInvalid, fmt::format("coordinates up to {:g} cannot be held by SEG-Y", largest));
}

struct Delay {
  int word = 0;
  int scalar = 1;
};

// z0 in the vertical unit with the coarsest decimal scalar that holds it exactly, or else the best one.
Delay choose_delay(const survey::Geometry& geometry, std::vector<std::string>& notes) {
  constexpr double kMost = std::numeric_limits<std::int16_t>::max();
  const double z0 = geometry.z0;
  Delay best;
  double least = std::numeric_limits<double>::infinity();
  for (const int scalar : {1, -10, -100, -1000, -10000, 10, 100, 1000, 10000}) {
    const double word = std::nearbyint(scalar < 0 ? z0 * -scalar : z0 / scalar);
    if (std::abs(word) > kMost) continue;
    const double error = std::abs((scalar < 0 ? word / -scalar : word * scalar) - z0);
    if (error < least - 1e-9 * (1 + std::abs(z0))) {
      least = error;
      best = {static_cast<int>(word), scalar};
    }
  }
  if (!std::isfinite(least)) {
    throw Error(ErrorCode::kInvalid, fmt::format("a first sample at {} cannot be held by SEG-Y", z0));
  }
  if (least > 1e-6 * geometry.interval) {
    notes.push_back(fmt::format("the first sample's z {} is rounded by {:.3g} {}", z0, least,
                                name_of(geometry.vertical_unit)));
  }
  return best;
}

// In thousandths of the vertical unit; 0 where 16 bits cannot hold it.
int plain_interval(const survey::Geometry& geometry) {
  const double thousandths = geometry.interval * 1000;
  const double whole = std::nearbyint(thousandths);
  const bool fits = whole >= 1 && whole <= std::numeric_limits<std::int16_t>::max() &&
                    std::abs(thousandths - whole) <= 1e-9 * thousandths;
  return fits ? static_cast<int>(whole) : 0;
}

struct Plan {
  const survey::Geometry& geometry;
  const WriteOptions& options;
  Positions positions;
  Delay delay;
  int interval = 0;  // thousandths; 0: only revision 2's double can say it
  bool revision2 = false;
  std::int64_t traces = 0;
};

int sample_word(const Plan& plan) {
  return plan.geometry.samples <= kMostPlainSamples ? static_cast<int>(plan.geometry.samples) : 0;
}

std::vector<std::byte> text_header(const Plan& plan) {
  const survey::Geometry& g = plan.geometry;
  const std::string unit(name_of(g.vertical_unit));
  const auto corner = [&](std::int64_t i, std::int64_t j) {
    const survey::WorldPoint p = g.world_of({static_cast<double>(i), static_cast<double>(j), 0});
    return fmt::format("INLINE {} CROSSLINE {}: X {:.3f} Y {:.3f}", g.inlines.line_of(i),
                       g.crosslines.line_of(j), p.x, p.y);
  };
  const std::int64_t i_end = g.inlines.count - 1;
  const std::int64_t j_end = g.crosslines.count - 1;
  std::vector<std::string> lines{
      "SEG-Y written by Footwall",
      "VOLUME " + plan.options.title,
      "MADE FROM " + plan.options.source,
      "",
      fmt::format("INLINES    {} to {} by {} ({})", g.inlines.first, g.inlines.last(), g.inlines.step,
                  g.inlines.count),
      fmt::format("CROSSLINES {} to {} by {} ({})", g.crosslines.first, g.crosslines.last(),
                  g.crosslines.step, g.crosslines.count),
      fmt::format("SAMPLES    {} every {} {} from {} {}", g.samples, g.interval, unit, g.z0, unit),
      fmt::format("DOMAIN     {}, z positive down, in {}", name_of(g.domain), unit),
      fmt::format("X AND Y    in {}, CRS {}", g.horizontal_unit, g.crs.empty() ? "not stated" : g.crs),
      "",
      corner(0, 0),
      corner(i_end, 0),
      corner(0, j_end),
      corner(i_end, j_end),
      "",
      fmt::format("SAMPLE FORMAT {}", plan.options.format == 1 ? "1, IBM float" : "5, IEEE float"),
      plan.options.holes == Holes::kDead ? "BINS WITHOUT A TRACE are traces of zeros with code 2 at byte 29"
                                         : "BINS WITHOUT A TRACE are left out",
      "",
      "TRACE HEADER BYTES",
      "  1 TRACE IN LINE   5 TRACE IN FILE   9 INLINE   21 CROSSLINE   29 CODE",
      " 71 COORDINATE SCALAR   73 X  77 Y  81 X  85 Y   89 UNIT OF COORDINATES",
      "109 FIRST SAMPLE, SCALED BY 215   115 SAMPLES   117 INTERVAL",
      "181 X  185 Y  189 INLINE  193 CROSSLINE"};
  if (g.domain == survey::Domain::kDepth) {
    lines.push_back(
        fmt::format("DEPTH: interval and first sample are in thousandths of {} and in {}", unit, unit));
  }
  lines.resize(38);
  lines.push_back(plan.revision2 ? "SEG-Y REV2.0" : "SEG Y REV1");
  lines.emplace_back("END TEXTUAL HEADER");
  std::vector<std::byte> bytes;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    std::string line = fmt::format("C{:2} {}", n + 1, lines[n]);
    line.resize(80, ' ');
    for (const char letter : line) bytes.push_back(ebcdic_from(letter));
  }
  return bytes;
}

std::vector<std::byte> binary_header(const Plan& plan) {
  const survey::Geometry& g = plan.geometry;
  Words words(400, 3200);
  words.int32(3201, 1);
  words.int32(3205, 1);
  words.int32(3209, 1);
  words.int16(3213, 1);
  words.int16(3217, plan.interval);
  words.int16(3219, plan.interval);
  words.uint16(3221, sample_word(plan));
  words.uint16(3223, sample_word(plan));
  words.int16(3225, plan.options.format);
  words.int16(3227, 1);  // one trace a bin
  words.int16(3229, 4);  // stacked
  words.int16(3255, g.horizontal_unit == "ft" ? 2 : 1);
  words.uint16(3501, plan.revision2 ? 0x0200 : 0x0100);
  words.int16(3503, 1);  // all traces are of one length
  if (plan.revision2) {
    words.int32(3269, static_cast<std::int32_t>(g.samples));
    words.float64(3273, g.interval * 1000);
    words.int32(3289, static_cast<std::int32_t>(g.samples));
    words.float64(3281, g.interval * 1000);
    words.int32(3297, 0x01020304);
    words.int64(3513, plan.traces);
    words.int64(3521, 3600);
  }
  return words.take();
}

// One trace with its header; called for traces in the order of the file.
class TraceWriter {
 public:
  TraceWriter(const Plan& plan, detail::OutputFile& out) : plan_(plan), out_(out) {
    samples_.resize(static_cast<std::size_t>(plan.geometry.samples));
  }

  void begin_line() { in_line_ = 0; }
  void write(std::int64_t i, std::int64_t j, bool dead, std::span<const float> values, Written& written) {
    put_header(i, j, dead);
    const bool ibm = plan_.options.format == 1;
    const std::optional<float> null_value = plan_.options.null_value;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      float value = dead ? 0 : values[k];
      if (!std::isfinite(value)) {
        ++written.nulls;
        if (null_value) {
          value = *null_value;
        } else {
          value = ibm ? 0 : std::numeric_limits<float>::quiet_NaN();
        }
      }
      const std::uint32_t bits = ibm ? ibm_from_float(value) : std::bit_cast<std::uint32_t>(value);
      samples_[k] = detail::swapped(bits);
    }
    out_.write(std::as_bytes(std::span<const std::uint32_t>(samples_)));
    ++(dead ? written.dead : written.traces);
  }

 private:
  void put_header(std::int64_t i, std::int64_t j, bool dead) {
    const survey::Geometry& g = plan_.geometry;
    const survey::WorldPoint at = g.world_of({static_cast<double>(i), static_cast<double>(j), 0});
    const auto inline_number = static_cast<std::int32_t>(g.inlines.line_of(i));
    const auto crossline_number = static_cast<std::int32_t>(g.crosslines.line_of(j));
    const auto x = static_cast<std::int32_t>(std::nearbyint(at.x * plan_.positions.factor));
    const auto y = static_cast<std::int32_t>(std::nearbyint(at.y * plan_.positions.factor));
    Words words(240, 0);
    words.int32(1, static_cast<std::int32_t>(++in_line_));
    in_file_ = in_file_ == std::numeric_limits<std::int32_t>::max() ? 1 : in_file_ + 1;
    words.int32(5, in_file_);
    words.int32(9, inline_number);
    words.int32(13, static_cast<std::int32_t>(in_line_));
    words.int32(21, crossline_number);
    words.int32(25, 1);
    words.int16(29, dead ? 2 : 1);
    words.int16(33, 1);
    words.int16(35, 1);  // production data
    words.int16(69, 1);
    words.int16(71, plan_.positions.scalar);
    for (const int byte : {73, 81, 181}) words.int32(byte, x);
    for (const int byte : {77, 85, 185}) words.int32(byte, y);
    words.int16(89, 1);  // lengths
    words.int16(109, plan_.delay.word);
    words.uint16(115, sample_word(plan_));
    words.int16(117, plan_.interval);
    words.int32(189, inline_number);
    words.int32(193, crossline_number);
    words.int16(215, plan_.delay.scalar);
    out_.write(words.bytes());
  }

  const Plan& plan_;
  detail::OutputFile& out_;
  std::int64_t in_line_ = 0;
  std::int32_t in_file_ = 0;
  std::vector<std::uint32_t> samples_;
};

Plan planned(const survey::Geometry& geometry, const WriteOptions& options, std::int64_t traces,
             Written& written) {
  Plan plan{geometry,
            options,
            choose_positions(geometry, written.notes),
            choose_delay(geometry, written.notes),
            plain_interval(geometry),
            false,
            traces};
  if (plan.interval == 0) {
    written.notes.push_back(fmt::format(
        "the sample interval {} {} is no whole number of thousandths up to 32767: it is in revision "
        "2's words only (binary header, bytes 3273 and 3281)",
        geometry.interval, name_of(geometry.vertical_unit)));
  }
  if (geometry.samples > kMostPlainSamples) {
    written.notes.push_back(
        fmt::format("{} samples a trace are in revision 2's word only (byte 3269)", geometry.samples));
  } else if (geometry.samples > std::numeric_limits<std::int16_t>::max()) {
    written.notes.push_back(
        fmt::format("{} samples a trace: programs that take the count for a signed word will not read it",
                    geometry.samples));
  }
  plan.revision2 = plan.interval == 0 || geometry.samples > kMostPlainSamples;
  written.revision = plan.revision2 ? 2 : 1;
  written.coordinate_scalar = plan.positions.scalar;
  return plan;
}

}  // namespace

Written write(const std::filesystem::path& path, const survey::Geometry& geometry,
              std::span<const std::uint8_t> live, const BlockReader& read, std::int64_t chunk_lines,
              const WriteOptions& options, const JobContext& job) {
  if (options.format != 1 && options.format != 5) {
    throw Error(ErrorCode::kUsage, fmt::format("SEG-Y is not written in sample format {}", options.format),
                "5 is IEEE float, 1 is IBM float");
  }
  const std::int64_t inlines = geometry.inlines.count;
  const std::int64_t crosslines = geometry.crosslines.count;
  require(live.size() == static_cast<std::size_t>(inlines * crosslines), "live has a byte a trace");
  const std::int64_t alive =
      std::count_if(live.begin(), live.end(), [](std::uint8_t one) { return one != 0; });
  if (alive == 0) {
    throw Error(ErrorCode::kInvalid, "the volume has no trace: SEG-Y without traces cannot be read");
  }
  Written written;
  const bool fill_holes = options.holes == Holes::kDead;
  const Plan plan = planned(geometry, options, fill_holes ? inlines * crosslines : alive, written);

  detail::OutputFile out(path);
  out.write(text_header(plan));
  out.write(binary_header(plan));
  TraceWriter trace(plan, out);
  const std::int64_t line = crosslines * geometry.samples;
  const std::int64_t lines =
      std::clamp<std::int64_t>(kMostSamples / line, 1, std::max<std::int64_t>(1, chunk_lines));
  // A line too long for memory is read in parts.
  const std::int64_t traces_at_once = lines > 1 || line <= kMostSamples
                                          ? crosslines
                                          : std::max<std::int64_t>(1, kMostSamples / geometry.samples);
  std::vector<float> values;
  for (std::int64_t i = 0; i < inlines; i += lines) {
    const std::int64_t i_end = std::min(i + lines, inlines);
    for (std::int64_t j = 0; j < crosslines; j += traces_at_once) {
      const std::int64_t j_end = std::min(j + traces_at_once, crosslines);
      job.report(static_cast<double>(i * crosslines + j) / static_cast<double>(inlines * crosslines),
                 "write SEG-Y", fmt::format("{} of {} inlines", i, inlines));
      const survey::Box box{{i, j, 0}, {i_end, j_end, geometry.samples}};
      values.resize(static_cast<std::size_t>(box.count()));
      read(box, values);
      const float* samples = values.data();
      for (std::int64_t a = i; a < i_end; ++a) {
        if (j == 0) trace.begin_line();
        for (std::int64_t b = j; b < j_end; ++b, samples += geometry.samples) {
          const bool dead = live[static_cast<std::size_t>(a * crosslines + b)] == 0;
          if (dead && !fill_holes) {
            ++written.skipped;
            continue;
          }
          trace.write(a, b, dead, {samples, static_cast<std::size_t>(geometry.samples)}, written);
        }
      }
    }
  }
  out.commit();
  written.traces += written.dead;
  if (written.nulls > 0 && options.format == 1 && !options.null_value) {
    written.notes.push_back(fmt::format("{} null samples became 0: IBM floats have no null", written.nulls));
  }
  job.report(1, "write SEG-Y", fmt::format("{0} of {0} inlines", inlines));
  return written;
}

std::uint32_t ibm_from_float(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits & 0x80000000u;
  std::uint64_t fraction = bits & 0x007FFFFFu;
  int exponent = static_cast<int>((bits >> 23) & 0xFF);
  if (exponent == 0 && fraction == 0) return sign;
  if (exponent == 0) {
    exponent = 1;  // a subnormal number has no hidden bit
  } else {
    fraction |= 0x00800000u;
  }
  // value = fraction * 2^(exponent - 150). As 0.f * 16^e with f of 24 bits: bring f's top hexadecimal digit
  // into place, the binary exponent to a multiple of four.
  int binary = exponent - 150 + 24;  // value = (fraction / 2^24) * 2^binary
  while (fraction < 0x00800000u) {
    fraction <<= 1;
    --binary;
  }
  const int hex = binary >= 0 ? (binary + 3) / 4 : -(-binary / 4);
  const int right = 4 * hex - binary;  // 0 to 3 bits are lost
  const std::uint64_t half = right == 0 ? 0 : std::uint64_t{1} << (right - 1);
  const std::uint64_t rest = fraction & ((std::uint64_t{1} << right) - 1);
  std::uint64_t rounded = fraction >> right;
  if (rest > half || (rest == half && half != 0 && (rounded & 1) != 0)) ++rounded;
  // Rounding up cannot leave 24 bits: with right > 0 the fraction has bits to spare at its top.
  return sign | static_cast<std::uint32_t>(hex + 64) << 24 | static_cast<std::uint32_t>(rounded);
}

}  // namespace footwall::formats::segy
