#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include "real_files.h"
#include "storage/base/error.h"
#include "storage/formats/segy/survey_scan.h"

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

struct Refusal {
  ErrorCode code;
  std::string reason;  // a part of the message
};
// Why some files are refused.
const std::map<std::string, Refusal> kRefused{
    {"1x1.sgy", {ErrorCode::kUnsupported, "prestack"}},
    {"1xN.sgy", {ErrorCode::kUnsupported, "prestack"}},
    {"Mx1.sgy", {ErrorCode::kUnsupported, "prestack"}},
    {"small-ps.sgy", {ErrorCode::kUnsupported, "prestack"}},
    {"small-ps-dec-il-inc-xl-off.sgy", {ErrorCode::kUnsupported, "prestack"}},
    {"small-ps-dec-il-xl-off.sgy", {ErrorCode::kUnsupported, "prestack"}},
    {"text.sgy", {ErrorCode::kFormat, "no trace"}},
    {"interval-neg-bin-neg-trace.sgy", {ErrorCode::kFormat, "no header has a usable sample interval"}},
    {"shot-gather.sgy", {ErrorCode::kInvalid, "61 traces share 1 pairs of line numbers"}},
    {"increment.sgy", {ErrorCode::kInvalid, "make no survey"}},  // line numbers near -2^31
    {"long.sgy", {ErrorCode::kInvalid, "make no survey"}},
};

// Facts that are told by words of the header that the file says to be elsewhere, or that the manifest took
// from revision 2's fields of a file of no known revision.
const std::map<std::string, std::vector<std::string>> kOtherFacts{
    {"mapping-shifted.sgy", {"IL(189) ", "XL(193) "}},
    {"increment.sgy", {" ns=", " dt="}},
};

struct Facts {
  const RealFile& file;
  std::string number(const std::string& mark) const {
    const auto other = kOtherFacts.find(file.name);
    if (other != kOtherFacts.end() && std::count(other->second.begin(), other->second.end(), mark) > 0)
      return {};
    return stated_after(file.facts, mark);
  }
  template <class Number>
  void expect(const std::string& mark, Number value) const {
    const std::string stated = number(mark);
    if (stated.empty()) return;
    EXPECT_EQ(static_cast<double>(value), std::stod(stated)) << mark;
  }
};

// What is known of a file whether it is imported or not.
void compare_headers(const Facts& facts, const Report& report) {
  const std::string& text = facts.file.facts;
  EXPECT_EQ(name_of(report.endian), text.substr(6, text.find(' ', 6) - 6));
  EXPECT_EQ(report.text_is_ebcdic,
            text.find("ASCII") == std::string::npos && text.find(" 0x00 ") == std::string::npos);
  const std::string revision =
      std::to_string(report.revision_major) + "." + std::to_string(report.revision_minor);
  EXPECT_NE(text.find(" rev" + revision + " "), std::string::npos) << revision;
  facts.expect(" fmt", report.format);
  facts.expect(" ns=", report.samples);
  facts.expect(" traces=", report.traces);
  if (report.interval_us > 0) facts.expect(" dt=", report.interval_us);
  const std::string blocks = facts.number("ext text ");
  EXPECT_EQ(report.extended_text_header.size(), blocks.empty() ? 0 : std::stoul(blocks) * 40);
}

void compare_lines(const Facts& facts, const std::string& mark, const survey::LineAxis& axis) {
  const std::string first = facts.number(mark);
  if (first.empty()) return;
  EXPECT_EQ(axis.first, std::stoi(first));
  EXPECT_EQ(axis.last(), std::stoi(stated_after(facts.file.facts, mark + first + "..")));
  EXPECT_EQ(axis.count, std::stoi(stated_after(facts.file.facts,
                                               mark + first + ".." + std::to_string(axis.last()) + "(")));
}

void compare_volume(const Facts& facts, const Volume& read) {
  compare_lines(facts, "IL(189) ", read.geometry.inlines);
  compare_lines(facts, "XL(193) ", read.geometry.crosslines);
  compare_lines(facts, "CDP(21) ", read.geometry.crosslines);
  EXPECT_EQ(read.report.live_traces, read.report.traces);
  float low = std::numeric_limits<float>::infinity(), high = -low;
  std::int64_t silent = 0;
  const auto column = static_cast<std::size_t>(read.geometry.samples);
  for (std::size_t trace = 0; trace < read.live.size(); ++trace) {
    if (read.live[trace] == 0) continue;
    bool any = false;
    for (std::size_t n = trace * column; n < (trace + 1) * column; ++n) {
      low = std::min(low, read.values[n]);
      high = std::max(high, read.values[n]);
      any = any || read.values[n] != 0;
    }
    silent += any ? 0 : 1;
  }
  const double lowest = std::stod(facts.number("; min ")), highest = std::stod(facts.number(" max "));
  EXPECT_NEAR(low, lowest, 1e-6 * std::fabs(lowest));
  EXPECT_NEAR(high, highest, 1e-6 * std::fabs(highest));
  facts.expect("all-zero traces ", silent);
}

TEST(RealSegy, EveryFileHasTheFactsOfTheManifestOrIsRefusedForAReason) {
  FOOTWALL_NEEDS_REAL_FILES();
  int read = 0, refused = 0;
  for (const RealFile& file : manifest()) {
    if (file.category != "segy" || file.path.extension() == ".npy") continue;
    SCOPED_TRACE(file.path.string());
    ASSERT_TRUE(file.facts.starts_with("SEG-Y ")) << "the manifest has no facts";
    EXPECT_TRUE(looks_like_segy(file.path));
    const Inspection found = inspect(file.path, {}, {});
    compare_headers({file}, found.report);
    const auto expected = kRefused.find(file.name);
    if (expected == kRefused.end()) {
      ASSERT_FALSE(found.refusal) << found.refusal->message();
      compare_volume({file}, whole(file.path));
      ++read;
      continue;
    }
    ASSERT_TRUE(found.refusal) << "was read";
    EXPECT_EQ(found.refusal->code(), expected->second.code);
    EXPECT_NE(found.refusal->message().find(expected->second.reason), std::string::npos)
        << found.refusal->message();
    EXPECT_FALSE(found.refusal->hint().empty());
    EXPECT_THROW(whole(file.path), Error);
    ++refused;
  }
  EXPECT_GE(read, 45);
  EXPECT_EQ(refused, static_cast<int>(kRefused.size()));
}

// Single traces, with the samples that another reader found in them.
TEST(RealSegy, SamplesAreThoseOfTheArraysBesideTheFiles) {
  FOOTWALL_NEEDS_REAL_FILES();
  int compared = 0;
  for (const RealFile& file : manifest()) {
    if (file.path.extension() != ".npy") continue;
    SCOPED_TRACE(file.path.string());
    auto traces = file.path;
    const Volume read = whole(traces.replace_extension());
    std::ifstream in(file.path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    ASSERT_NE(bytes.find("'descr': '<f4'"), std::string::npos);
    const std::size_t start = bytes.find('\n') + 1;
    std::vector<float> samples((bytes.size() - start) / sizeof(float));
    std::memcpy(samples.data(), bytes.data() + start, samples.size() * sizeof(float));
    EXPECT_EQ(read.values, samples);
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

// Where a file says itself what stands where, that holds.
TEST(RealSegy, LayoutStanzasAreFollowed) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto folder = real_files() / "equinor+segyio/test-data";
  const Volume plain = whole(folder / "tiny.sgy");
  EXPECT_EQ(plain.geometry.dims(), (survey::Index{3, 2, 4}));
  for (const char* name : {"mapping-default.sgy", "mapping-minimal.sgy", "mapping-shifted.sgy",
                           "stanzas-known-count.sgy", "trace-header-extension1.sgy"}) {
    SCOPED_TRACE(name);
    const Volume read = whole(folder / name);
    EXPECT_EQ(read.geometry.inlines, plain.geometry.inlines);
    EXPECT_EQ(read.geometry.crosslines, plain.geometry.crosslines);
    EXPECT_EQ(read.values, plain.values);
  }
  EXPECT_EQ(whole(folder / "mapping-shifted.sgy").report.inline_word, HeaderWord(190));
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

TEST(RealSegy, LinesWithoutLineNumbersAreFound) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto volve = real_files() / "trhallam+segysak/tests/test-data-volve/volve10r12-full-z-il10117sub.sgy";
  const Volume line = whole(volve);
  EXPECT_EQ(line.geometry.dims(), (survey::Index{1, 202, 1125}));
  EXPECT_EQ(line.report.crossline_word, HeaderWord(21));
  EXPECT_DOUBLE_EQ(line.geometry.z0, 4);
  EXPECT_NEAR(std::hypot(line.geometry.map.per_crossline_x, line.geometry.map.per_crossline_y), 12.5, 0.2);
  ASSERT_FALSE(line.geometry.assumed.empty());
  EXPECT_NE(line.geometry.assumed[0].find("line_2d"), std::string::npos);
  Options options;
  options.preset = "line_2d";
  EXPECT_EQ(whole(volve, options).values, line.values);
  // Neither line nor ensemble numbers: the order in the file, which the coordinates follow.
  const Volume small = whole(real_files() / "equinor+seismic-zfp/test_data/small-2d.sgy");
  EXPECT_EQ(small.geometry.dims(), (survey::Index{1, 25, 50}));
  EXPECT_EQ(small.report.crossline_word, kOrderWord);
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
