#include <cmath>
#include <limits>
#include <map>

#include "real_files.h"
#include "storage/base/error.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::formats::segy {
namespace {

struct Volume {
  survey::Geometry geometry;
  Report report;
  std::vector<float> values;
  std::vector<std::uint8_t> live;
};

Volume whole(const std::filesystem::path& path, const Options& options = {}) {
  const SegyFile file = SegyFile::scan(path, options);
  const survey::Box box = file.geometry().box();
  Volume read{file.geometry(), file.report(), std::vector<float>(static_cast<std::size_t>(box.count())),
              std::vector<std::uint8_t>(static_cast<std::size_t>(box.size(0) * box.size(1)))};
  file.read_block(box, read.values, read.live);
  return read;
}

// Why some files are refused, and that they are.
const std::map<std::string, ErrorCode> kRefused{
    {"1x1.sgy", ErrorCode::kUnsupported},  // prestack, as the next ones
    {"1xN.sgy", ErrorCode::kUnsupported},
    {"Mx1.sgy", ErrorCode::kUnsupported},
    {"mapping-minimal.sgy", ErrorCode::kUnsupported},
    {"small-ps.sgy", ErrorCode::kUnsupported},
    {"small-ps-dec-il-inc-xl-off.sgy", ErrorCode::kUnsupported},
    {"small-ps-dec-il-xl-off.sgy", ErrorCode::kUnsupported},
    {"text.sgy", ErrorCode::kFormat},                        // no trace
    {"interval-neg-bin-neg-trace.sgy", ErrorCode::kFormat},  // no usable interval
    {"shot-gather.sgy", ErrorCode::kInvalid},                // no line numbers, as the next ones
    {"small-2d.sgy", ErrorCode::kInvalid},
    {"volve10r12-full-z-il10117sub.sgy", ErrorCode::kInvalid},
    {"increment.sgy", ErrorCode::kInvalid},  // line numbers that make no survey
    {"long.sgy", ErrorCode::kInvalid},
    {"mapping-shifted.sgy", ErrorCode::kInvalid},  // all words one byte off
};

void compare_with_facts(const RealFile& file, const Volume& read) {
  const std::string& facts = file.facts;
  const auto number = [&](const std::string& mark) { return stated_after(facts, mark); };
  EXPECT_EQ(name_of(read.report.endian), facts.substr(6, facts.find(' ', 6) - 6));
  EXPECT_EQ(read.report.text_is_ebcdic,
            facts.find("ASCII") == std::string::npos && facts.find(" 0x00 ") == std::string::npos);
  EXPECT_EQ(read.report.format, std::stoi(number(" fmt")));
  EXPECT_EQ(read.report.samples, std::stoi(number(" ns=")));
  EXPECT_EQ(read.report.interval_us, std::stod(number(" dt=")));
  EXPECT_EQ(read.report.traces, std::stoi(number(" traces=")));
  const auto check_lines = [&](const std::string& mark, const survey::LineAxis& axis) {
    const std::string first = number(mark);
    if (first.empty()) return;
    EXPECT_EQ(axis.first, std::stoi(first));
    EXPECT_EQ(axis.last(), std::stoi(number(mark + first + "..")));
  };
  check_lines("IL(189) ", read.geometry.inlines);
  check_lines("XL(193) ", read.geometry.crosslines);
  const double lowest = std::stod(number("; min ")), highest = std::stod(number(" max "));
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float value : read.values) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  EXPECT_NEAR(low, lowest, 1e-6 * std::fabs(lowest));
  EXPECT_NEAR(high, highest, 1e-6 * std::fabs(highest));
}

TEST(RealSegy, EveryFileHasTheFactsOfTheManifestOrIsRefusedForAReason) {
  FOOTWALL_NEEDS_REAL_FILES();
  int read = 0;
  for (const RealFile& file : manifest()) {
    if (file.category != "segy" || !file.facts.starts_with("SEG-Y ")) continue;
    SCOPED_TRACE(file.path.string());
    const auto refused = kRefused.find(file.name);
    if (refused == kRefused.end()) {
      EXPECT_TRUE(looks_like_segy(file.path));
      compare_with_facts(file, whole(file.path));
      ++read;
      continue;
    }
    try {
      whole(file.path);
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), refused->second) << error.message();
    }
  }
  EXPECT_GT(read, 25);
}

// The F3 cut-out as other formats and byte orders: the same volume, or what the narrower integers leave of
// it.
TEST(RealSegy, F3IsTheSameInEveryFormatAndByteOrder) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto folder = real_files() / "equinor+segyio/test-data";
  const Volume f3 = whole(folder / "f3.sgy");
  EXPECT_EQ(f3.geometry.dims(), (survey::Index{23, 18, 75}));
  EXPECT_EQ(f3.report.live_traces, 414);
  EXPECT_DOUBLE_EQ(f3.geometry.interval, 4);
  EXPECT_DOUBLE_EQ(f3.geometry.z0, 4);
  EXPECT_NEAR(f3.geometry.world_of({0, 0, 0}).x, 620197.2, 0.1);  // the file rounds to 0.1
  EXPECT_NEAR(f3.geometry.world_of({0, 0, 0}).y, 6074232.9, 0.1);
  EXPECT_NEAR(std::hypot(f3.geometry.map.per_inline_x, f3.geometry.map.per_inline_y), 25, 0.05);
  EXPECT_LT(f3.report.residual, 0.1);
  int variants = 0;
  for (const RealFile& file : manifest()) {
    if (file.path.parent_path().filename() != "multiformats") continue;
    SCOPED_TRACE(file.name);
    const Volume variant = whole(file.path);
    EXPECT_EQ(variant.geometry, f3.geometry);
    ASSERT_EQ(variant.values.size(), f3.values.size());
    const bool equal = file.facts.find("samples exactly equal f3.sgy") != std::string::npos;
    const bool low_byte = file.facts.find("int8 = low byte") != std::string::npos;
    const bool modulo16 = file.facts.find("mod 2^16") != std::string::npos;
    const bool modulo8 = file.facts.find("mod 2^8") != std::string::npos;
    ASSERT_TRUE(equal || low_byte || modulo16 || modulo8) << file.facts;
    for (std::size_t n = 0; n < f3.values.size(); ++n) {
      const int value = static_cast<int>(f3.values[n]);
      const int expected = low_byte   ? static_cast<std::int8_t>(value)
                           : modulo16 ? static_cast<std::uint16_t>(value)
                           : modulo8  ? static_cast<std::uint8_t>(value)
                                      : value;
      ASSERT_EQ(variant.values[n], static_cast<float>(expected)) << n;
    }
    ++variants;
  }
  EXPECT_GE(variants, 5);
}

TEST(RealSegy, TheSmallFilesDifferOnlyAsTheirNamesSay) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto segyio = real_files() / "equinor+segyio/test-data";
  const auto zfp = real_files() / "equinor+seismic-zfp/test_data";
  const Volume small = whole(segyio / "small.sgy");
  EXPECT_EQ(small.geometry.dims(), (survey::Index{5, 5, 50}));
  EXPECT_EQ(whole(segyio / "small-lsb.sgy").values, small.values);
  for (const char* name : {"normal-small.sgy", "acute-small.sgy", "left-small.sgy", "right-small.sgy"}) {
    EXPECT_EQ(whole(segyio / name).values, small.values) << name;
  }
  const Volume hole = whole(zfp / "small_hole.sgy");
  EXPECT_EQ(hole.report.live_traces, 24);
  EXPECT_EQ(hole.report.missing_bins, 1);
  const Volume negative = whole(zfp / "small_negative_il_xl.sgy");
  EXPECT_EQ(negative.geometry.inlines, (survey::LineAxis{-5, 1, 5}));
  EXPECT_EQ(negative.geometry.crosslines, (survey::LineAxis{-24, 1, 5}));
  EXPECT_EQ(negative.values.front(), small.values[small.values.size() - 50]);  // the axes are turned
  const Volume decimated = whole(zfp / "small-dec.sgy");
  EXPECT_EQ(decimated.geometry.inlines, (survey::LineAxis{1, 2, 3}));
  EXPECT_EQ(decimated.geometry.crosslines, (survey::LineAxis{20, 2, 3}));
  EXPECT_EQ(decimated.report.missing_bins, 0);
}

// Their names say by how many degrees the survey is turned.
TEST(RealSegy, RotatedSurveysHaveTheirMaps) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto folder = real_files() / "equinor+segyio/test-data";
  for (const char* name : {"normal-small.sgy", "acute-small.sgy", "left-small.sgy", "right-small.sgy"}) {
    const Volume read = whole(folder / name);
    EXPECT_TRUE(std::isfinite(read.report.residual)) << name;
    EXPECT_LT(read.report.residual, 0.5) << name;
  }
  const Volume normal = whole(folder / "normal-small.sgy");
  EXPECT_EQ(normal.report.without_coordinates, 0);  // its first trace really stands at (0, 0)
}

TEST(RealSegy, ALineWithoutLineNumbersIsReadByItsEnsembleNumbers) {
  FOOTWALL_NEEDS_REAL_FILES();
  Options options;
  options.inline_byte = 189;
  options.crossline_byte = 21;
  options.x_byte = 73;
  options.y_byte = 77;
  const Volume line = whole(
      real_files() / "trhallam+segysak/tests/test-data-volve/volve10r12-full-z-il10117sub.sgy", options);
  EXPECT_EQ(line.geometry.dims(), (survey::Index{1, 202, 1125}));
  EXPECT_DOUBLE_EQ(line.geometry.z0, 4);
  EXPECT_NEAR(std::hypot(line.geometry.map.per_crossline_x, line.geometry.map.per_crossline_y), 12.5, 0.2);
}

TEST(RealSegy, DelayScalesBy215) {
  FOOTWALL_NEEDS_REAL_FILES();
  EXPECT_DOUBLE_EQ(whole(real_files() / "equinor+segyio/test-data/delay-scalar.sgy").geometry.z0, 1000);
}

TEST(RealSegy, VolveDepthCubeHasStepsAndMetres) {
  FOOTWALL_NEEDS_REAL_FILES();
  Options options;
  options.domain = survey::Domain::kDepth;
  options.vertical_unit = survey::VerticalUnit::kMetre;
  const Volume volve =
      whole(real_files() / "trhallam+segysak/examples/data/volve10-migvel-depth-sub3d.sgy", options);
  EXPECT_EQ(volve.geometry.dims(), (survey::Index{18, 52, 226}));
  EXPECT_EQ(volve.geometry.inlines, (survey::LineAxis{10087, 4, 18}));
  EXPECT_EQ(volve.geometry.crosslines, (survey::LineAxis{2148, 4, 52}));
  EXPECT_DOUBLE_EQ(volve.geometry.interval, 20);
  EXPECT_LT(volve.report.residual, 0.1);
}

}  // namespace
}  // namespace footwall::formats::segy
