#include "storage/formats/nrrd.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "rounds.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::nrrd {
namespace {

constexpr survey::Index kSizes{4, 3, 5};  // fastest first

template <class Number>
std::string samples_of(bool big) {
  std::string bytes;
  for (int n = 0; n < 60; ++n) {
    const auto value = static_cast<Number>(n * 2 - (std::is_signed_v<Number> ? 50 : 0));
    std::string one(sizeof value, '\0');
    std::memcpy(one.data(), &value, sizeof value);
    if (big) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

std::string packed(const std::string& bytes, int window = 15 + 16) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY);
  std::string out(bytes.size() + 1000, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  const std::size_t size = stream.total_out;
  deflateEnd(&stream);
  return out.substr(0, size);
}

std::string header(const std::string& type, const std::string& more = "encoding: raw\n") {
  return "NRRD0004\n# made\ntype: " + type + "\ndimension: 3\nsizes: 4 3 5\n" + more;
}

std::vector<float> all_of(const std::filesystem::path& path, const ScratchFolder& folder,
                          const raw::AxisOrder& order = {2, 1, 0}) {
  const NrrdFile file(path, folder.path(), {});
  survey::Box box;
  for (std::size_t n = 0; n < 3; ++n)
    box.hi[static_cast<std::size_t>(order[2 - n])] = file.header().axes[n].size;
  std::vector<float> values(static_cast<std::size_t>(box.count()));
  file.read_block(order, box, values);
  return values;
}

// In the file's order.
void expect_ramp(const std::vector<float>& values, float first) {
  ASSERT_EQ(values.size(), 60u);
  for (int n = 0; n < 60; ++n) {
    const int a = n % 4, b = n / 4 % 3, c = n / 12;  // fastest first; values are [a][b][c] in order kji
    EXPECT_EQ(values[(a * 3 + b) * 5 + c], first + 2 * n);
  }
}

ErrorCode refusal(const std::filesystem::path& path, const ScratchFolder& folder) {
  try {
    all_of(path, folder);
  } catch (const Error& error) {
    EXPECT_FALSE(error.message().empty());
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(Nrrd, ReadsEveryTypeInBothByteOrdersPackedOrNot) {
  const ScratchFolder folder;
  const auto check = [&]<class Number>(const char* name, Number) {
    for (const bool big : {false, true}) {
      const std::string endian = big ? "endian: big\n" : "endian: little\n";
      const std::string samples = samples_of<Number>(big);
      const float first = std::is_signed_v<Number> ? -50 : 0;
      expect_ramp(all_of(folder.file("a.nrrd", header(name, endian + "encoding: raw\n\n") + samples), folder),
                  first);
      expect_ramp(all_of(folder.file("b.nrrd", header(name, endian + "encoding: gzip\n\n") + packed(samples)),
                         folder),
                  first);
    }
  };
  check("signed char", std::int8_t{});
  check("uchar", std::uint8_t{});
  check("short", std::int16_t{});
  check("unsigned short int", std::uint16_t{});
  check("int", std::int32_t{});
  check("uint32_t", std::uint32_t{});
  check("long long", std::int64_t{});
  check("uint64", std::uint64_t{});
  check("float", float{});
  check("double", double{});
}

TEST(Nrrd, AnyAxisOrderAndBlock) {
  const ScratchFolder folder;
  const auto path = folder.file(
      "a.nrrd", header("short", "endian: little\nencoding: raw\n\n") + samples_of<std::int16_t>(false));
  const NrrdFile file(path, folder.path(), {});
  for (const char* name : {"ijk", "ikj", "jik", "jki", "kij", "kji"}) {
    const raw::AxisOrder order = raw::axis_order_from(name);
    survey::Index dims{};
    for (std::size_t n = 0; n < 3; ++n) dims[static_cast<std::size_t>(order[2 - n])] = kSizes[n];
    const survey::Box box{{1, 1, 1}, {dims[0], dims[1], dims[2]}};
    std::vector<float> values(static_cast<std::size_t>(box.count()));
    file.read_block(order, box, values);
    std::size_t at = 0;
    for (std::int64_t i = 1; i < dims[0]; ++i) {
      for (std::int64_t j = 1; j < dims[1]; ++j) {
        for (std::int64_t k = 1; k < dims[2]; ++k) {
          const survey::Index p{i, j, k};
          const std::int64_t place =
              (p[static_cast<std::size_t>(order[0])] * 3 + p[static_cast<std::size_t>(order[1])]) * 4 +
              p[static_cast<std::size_t>(order[2])];
          ASSERT_EQ(values[at++], static_cast<float>(2 * place - 50)) << name;
        }
      }
    }
  }
}

TEST(Nrrd, HeadersInTheWild) {
  const ScratchFolder folder;
  const std::string samples = samples_of<std::uint8_t>(false);
  // CR LF, capitals, no blank after the colon, key:=value with a colon inside, fields that do not matter.
  const auto path =
      folder.file("a.nrrd",
                  "NRRD0001\r\nContent: caf\xC3\xA9: one\r\nType:uint8\r\nDimension: 3\r\nSizes: 4 3 5\r\n"
                  "who:=a: b\r\nold min: 3\r\nEncoding: Raw\r\n\r\n" +
                      samples);
  expect_ramp(all_of(path, folder), 0);
  const Header told = read_header(path);
  EXPECT_EQ(told.content, "caf\xC3\xA9: one");
  EXPECT_EQ(told.keys.at("who"), "a: b");
  EXPECT_EQ(told.skipped, std::vector<std::string>{"oldmin"});
  EXPECT_TRUE(told.notes.empty());
  // Skips: lines and bytes before the samples, in both encodings; and the last bytes of the file.
  const std::string skips = "line skip: 2\nbyte skip: 3\n";
  expect_ramp(
      all_of(folder.file("b.nrrd", header("uint8", skips + "encoding: raw\n\n") + "x\n\nabc" + samples),
             folder),
      0);
  expect_ramp(all_of(folder.file("c.nrrd", header("uint8", skips + "encoding: gz\n\n") + "x\n\n" +
                                               packed("abc" + samples)),
                     folder),
              0);
  expect_ramp(all_of(folder.file("d.nrrd", header("uint8", "byte skip: -1\nencoding: raw\n\n") +
                                               "junk of any size" + samples),
                     folder),
              0);
  // Several gzip members one after the other, zlib's own wrapping, and padding behind the last.
  const std::string parts = packed(samples.substr(0, 20)) + packed(samples.substr(20)) + std::string(9, '\0');
  expect_ramp(all_of(folder.file("e.nrrd", header("uint8", "encoding: gzip\n\n") + parts), folder), 0);
  expect_ramp(
      all_of(folder.file("f.nrrd", header("uint8", "encoding: gzip\n\n") + packed(samples, 15)), folder), 0);
  // Dimensions of one.
  expect_ramp(
      all_of(
          folder.file(
              "g.nrrd",
              "NRRD0005\ntype: uint8\ndimension: 4\nsizes: 1 4 3 5\nspacings: nan 1 1 1\nencoding: raw\n\n" +
                  samples),
          folder),
      0);
  const Header section = read_header(
      folder.file("h.nrrd", "NRRD0005\ntype: uint8\ndimension: 2\nsizes: 12 5\nencoding: raw\n\n" + samples));
  EXPECT_EQ(section.axes[2].size, 1);
  EXPECT_EQ(default_order(section), (raw::AxisOrder{0, 2, 1}));
}

TEST(Nrrd, DetachedFiles) {
  const ScratchFolder folder;
  const std::string samples = samples_of<std::uint8_t>(false);
  std::filesystem::create_directory(folder / "slices of it");
  folder.file("all.raw", samples);
  for (int n = 0; n < 5; ++n) {
    folder.file(fmt::format("slices of it/s{:03}.raw", 10 - 2 * n), "head" + samples.substr(12 * n, 12));
    folder.file(fmt::format("t{}.gz", n), packed(samples.substr(12 * n, 12)));
  }
  const auto read = [&](const std::string& name, const std::string& more) {
    return all_of(folder.file(name, header("uint8", more)), folder);
  };
  expect_ramp(read("a.nhdr", "encoding: raw\ndata file: all.raw\n"), 0);
  expect_ramp(read("b.nhdr", "datafile: ./all.raw\nencoding: raw\n\n"), 0);
  expect_ramp(read("d.nhdr", "encoding: gzip\ndata file: t%d.gz 0 4 1 2\n"), 0);
  std::string list = "byte skip: 4\nencoding: raw\ndata file: LIST\n";
  for (int n = 0; n < 5; ++n) list += fmt::format("slices of it/s{:03}.raw\n", 10 - 2 * n);
  expect_ramp(read("e.nhdr", list), 0);
  for (int n = 0; n < 5; ++n)
    std::filesystem::copy(folder / fmt::format("slices of it/s{:03}.raw", 10 - 2 * n),
                          folder / fmt::format("s{:03}.raw", 10 - 2 * n));
  expect_ramp(read("f.nhdr", "byte skip: 4\nencoding: raw\ndata file: s%03d.raw 10 2 -2\n"), 0);
}

TEST(Nrrd, RefusesWithTheReason) {
  const ScratchFolder folder;
  const std::string samples = samples_of<std::uint8_t>(false);
  folder.file("all.raw", samples);
  const auto code = [&](const std::string& more) {
    return refusal(folder.file("a.nrrd", header("uint8", more)), folder);
  };
  for (const char* name : {"../all.raw", "/etc/passwd", "a/../../b", "..", "LIST\n../all.raw"}) {
    EXPECT_EQ(code(std::string("encoding: raw\ndata file: ") + name + "\n"), ErrorCode::kInvalid) << name;
  }
  EXPECT_EQ(code("encoding: raw\ndata file: ../%d 1 5 1\n"), ErrorCode::kInvalid);
  EXPECT_EQ(code("encoding: raw\ndata file: %s%n 1 5 1\n"), ErrorCode::kFormat);
  EXPECT_EQ(code("encoding: raw\ndata file: %d 1 9000000000 1\n"), ErrorCode::kFormat);
  EXPECT_EQ(code("encoding: raw\ndata file: %d 1 4 1\n"), ErrorCode::kFormat);  // 4 files, 5 slices
  EXPECT_EQ(code("encoding: raw\ndata file: not there\n"), ErrorCode::kNotFound);
  EXPECT_EQ(code("encoding: bzip2\n\n"), ErrorCode::kUnsupported);
  EXPECT_EQ(code("encoding: ascii\n\n1 2 3"), ErrorCode::kUnsupported);
  EXPECT_EQ(code("encoding: raw\n\n" + samples.substr(1)), ErrorCode::kCorrupt);
  EXPECT_EQ(code("encoding: gzip\n\n" + packed(samples.substr(1))), ErrorCode::kCorrupt);
  std::string broken = packed(samples + samples);
  broken[broken.size() / 2] = static_cast<char>(broken[broken.size() / 2] ^ 0x55);
  EXPECT_EQ(code("encoding: gzip\n\n" + broken.substr(0, 20)), ErrorCode::kCorrupt);
  EXPECT_EQ(code("encoding: raw\n"), ErrorCode::kFormat);  // no samples, no data file
  EXPECT_EQ(code("sizes: 4 3 0\nencoding: raw\n\n"), ErrorCode::kFormat);
  EXPECT_EQ(code("sizes: 4000000000000 3000000000000 5\nencoding: raw\n\n"), ErrorCode::kFormat);
  EXPECT_EQ(code("sizes: 400000 300000 5\nencoding: raw\n\n"), ErrorCode::kCorrupt);
  EXPECT_EQ(code("space directions: (1,2) none (nonsense\nencoding: raw\n\n"), ErrorCode::kFormat);
  EXPECT_EQ(refusal(folder.file("b.nrrd", "NRRD0009\n\n"), folder), ErrorCode::kUnsupported);
  EXPECT_EQ(refusal(folder.file("c.nrrd", "NRRD"), folder), ErrorCode::kFormat);
  EXPECT_EQ(refusal(folder.file("d.nrrd", ""), folder), ErrorCode::kFormat);
  EXPECT_EQ(
      refusal(folder.file("e.nrrd", "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 4 3 5\nencoding: raw\n\n"),
              folder),
      ErrorCode::kUnsupported);
  EXPECT_EQ(refusal(folder.file("f.nrrd", "NRRD0004\ntype: block\ndimension: 3\n"), folder),
            ErrorCode::kUnsupported);
}

survey::Geometry sample_geometry() {
  survey::Geometry g;
  g.inlines = {-30, 2, 4};
  g.crosslines = {1001, 3, 3};
  g.samples = 5;
  g.z0 = 812.5;
  g.interval = 1.0 / 3;
  g.domain = survey::Domain::kDepth;
  g.vertical_unit = survey::VerticalUnit::kFoot;
  g.horizontal_unit = "ft";
  g.map = {1500000.1, 21000000.7, 82.5, 11.25, -11.25, 82.5};
  g.crs = "NAD27 / Texas South Central";
  return g;
}

TEST(Nrrd, WhatIsWrittenIsReadBack) {
  const ScratchFolder folder;
  const auto value = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<float>(std::exp(double(i) - double(j) + 0.1 * double(k)));
  };
  const auto read = [&](const survey::Box& box, std::span<float> values) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = value(i, j, k);
      }
    }
  };
  for (survey::Geometry g : {sample_geometry(), [] {
                               survey::Geometry time = sample_geometry();
                               time.domain = survey::Domain::kTime;
                               time.vertical_unit = survey::VerticalUnit::kMillisecond;
                               time.horizontal_unit = "m";
                               time.crs.clear();
                               time.map.per_inline_x = -82.5;  // the other handedness
                               return time;
                             }()}) {
    for (const char* name : {"ijk", "kji", "jki"}) {
      const raw::AxisOrder order = raw::axis_order_from(name);
      write(folder / "a.nrrd", g, order, "caf\xC3\xA9\nwith a break", read);
      const Header told = read_header(folder / "a.nrrd");
      const Placed placed = geometry_of(told, order, {});
      EXPECT_TRUE(placed.complete);
      EXPECT_TRUE(placed.geometry.assumed.empty()) << placed.geometry.assumed[0];
      EXPECT_EQ(placed.geometry, g) << name;
      std::vector<float> wanted(60);
      read(g.box(), wanted);
      EXPECT_EQ(all_of(folder / "a.nrrd", folder, order), wanted);
    }
  }
}

TEST(Nrrd, SaysWhatItAssumed) {
  const ScratchFolder folder;
  const auto placed = [&](const std::string& more, const Meaning& meaning) {
    return geometry_of(read_header(folder.file("a.nrrd", header("uint8", more + "encoding: raw\n\n"))),
                       {2, 1, 0}, meaning);
  };
  Meaning depth;
  depth.domain = survey::Domain::kDepth;
  depth.vertical_unit = survey::VerticalUnit::kMetre;
  const Placed bare = placed("", depth);
  EXPECT_FALSE(bare.complete);
  EXPECT_EQ(bare.geometry.interval, 1);
  EXPECT_GE(bare.geometry.assumed.size(), 6u);
  const Placed spaced = placed("spacings: 3.2 -3 1500\nunits: \"mm\" \"mm\" \"mm\"\n", depth);
  EXPECT_DOUBLE_EQ(spaced.geometry.map.per_inline_y, 0.0032);
  EXPECT_DOUBLE_EQ(spaced.geometry.map.per_crossline_x, 0.003);
  EXPECT_DOUBLE_EQ(spaced.geometry.interval, 1.5);
  const Placed up = placed(
      "space: right-anterior-superior\nspace directions: (2,0,0) (0,2,0) (0,0,-5)\nspace origin: "
      "(10,20,30)\n",
      depth);
  EXPECT_TRUE(up.complete);
  EXPECT_EQ(up.geometry.z0, -30);
  EXPECT_EQ(up.geometry.interval, 5);
  const Placed tilted = placed(
      "space dimension: 3\nspace directions: (2,0,1) (0,2,0) (0,0,5)\nspace origin: (10,20,30)\n", depth);
  EXPECT_FALSE(tilted.complete);
  EXPECT_EQ(tilted.geometry.interval, 5);

  Meaning given;
  EXPECT_EQ(placed("spacings: 25 25 0.004\nunits: \"m\" \"m\" \"s\"\n", given).geometry.interval, 4);
  given.interval = 2;
  EXPECT_THROW(placed("spacings: 25 25 0.004\nunits: \"m\" \"m\" \"s\"\n", given), Error);
  given = {};
  given.domain = survey::Domain::kDepth;
  EXPECT_THROW(placed("spacings: 25 25 0.004\nunits: \"m\" \"m\" \"s\"\n", given), Error);
  EXPECT_THROW(placed("", {}), Error);  // neither says what z is
}

TEST(Nrrd, DamagedFilesAreReadOrRefused) {
  const ScratchFolder folder;
  const std::string good = header("short",
                                  "endian: big\nspacings: 1 2 3\nunits: \"m\" \"m\" \"ms\"\nspace "
                                  "directions: (1,0,0) (0,1,0) (0,0,1)\nkey:=value\nencoding: gzip\n\n") +
                           packed(samples_of<std::int16_t>(true));
  std::mt19937 random(3);
  for (int round = 0; round < rounds(300); ++round) {
    std::string bytes = good;
    for (int n = 0; n < 1 + round % 4; ++n) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.erase(at, random() % 9);
          break;
        case 2:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 30));
          break;
        default:
          bytes[at] = "0123456789-():\n\""[random() % 16];
      }
    }
    try {
      const auto path = folder.file("a.nrrd", bytes);
      const NrrdFile file(path, folder.path(), {});
      Meaning meaning;
      meaning.domain_otherwise = survey::Domain::kTime;
      meaning.unit_otherwise = survey::VerticalUnit::kMillisecond;
      const auto order = default_order(file.header());
      const survey::Geometry g = geometry_of(file.header(), order, meaning).geometry;
      float value = 0;
      file.read_block(order, {{g.inlines.count - 1, 0, 0}, {g.inlines.count, 1, 1}}, {&value, 1});
    } catch (const Error&) {
      continue;
    }
  }
  // No scratch is left behind.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace footwall::formats::nrrd
