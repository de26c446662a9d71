#include "storage/formats/segy/layout.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "rounds.h"
#include "scratch_folder.h"
#include "segy_sample_file.h"
#include "storage/base/error.h"

namespace footwall::formats::segy {
namespace {

ErrorCode code_of_scan(const std::filesystem::path& path, const Options& options = {}) {
  try {
    SegyFile::scan(path, options);
  } catch (const Error& error) {
    EXPECT_FALSE(error.message().empty());
    return error.code();
  }
  ADD_FAILURE() << "was read";
  return ErrorCode::kInternal;
}

std::vector<float> all_samples(const SegyFile& file) {
  const survey::Box box = file.geometry().box();
  std::vector<float> values(static_cast<std::size_t>(box.count()));
  std::vector<std::uint8_t> live(static_cast<std::size_t>(box.size(0) * box.size(1)));
  file.read_block(box, values, live);
  return values;
}

TEST(SegyLayout, EveryFormatAndByteOrderGivesTheSameVolume) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(1, 3, 5);
  const std::vector<float> expected{0, 1, 2, 3, 4, 10, 11, 12, 13, 14, 20, 21, 22, 23, 24};
  for (const int format : {1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16}) {
    for (const bool little : {false, true}) {
      made.format = format;
      made.little = little;
      const auto path = folder.file("a.sgy", made.bytes());
      const SegyFile file = SegyFile::scan(path, {});
      EXPECT_EQ(file.report().format, format);
      EXPECT_EQ(file.report().endian, little ? Endian::kLittle : Endian::kBig) << format;
      EXPECT_EQ(all_samples(file), expected) << format << (little ? " little" : " big");
      EXPECT_TRUE(looks_like_segy(path));
    }
  }
}

TEST(SegyLayout, Revision2StatesItsByteOrderAndLongFields) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(2, 2, 6);
  made.little = true;
  made.samples = 3;  // the long field wins
  made.binary[3501] = std::string("\x02\x00", 2);
  made.binary[3297] = made.word(0x01020304);
  made.binary[3269] = made.word(6);
  made.binary[3273] = std::string("\0\0\0\0\0\0\x5e\x40", 8);  // 120 us as a double
  made.binary[3513] = made.word(3);                            // traces; the fourth is a trailer
  const SegyFile file = SegyFile::scan(folder.file("a.sgy", made.bytes()), {});
  EXPECT_EQ(file.report().endian, Endian::kLittle);
  EXPECT_EQ(file.report().samples, 6);
  EXPECT_EQ(file.report().traces, 3);
  EXPECT_DOUBLE_EQ(file.geometry().interval, 0.12);
  made.binary[3297] = std::string("\x02\x01\x04\x03", 4);
  made.binary[3225] = made.half(5);
  EXPECT_EQ(code_of_scan(folder.file("b.sgy", made.bytes())), ErrorCode::kFormat);
}

TEST(SegyLayout, AdditionalTraceHeadersOfRevision2AreSkipped) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(2, 2, 60);
  made.binary[3501] = std::string("\x02\x01", 2);
  made.binary[3507] = made.half(1);
  for (SampleTrace& trace : made.traces) {
    // 240 further bytes: as many float samples of zero in front of the trace's own
    trace.values.insert(trace.values.begin(), 60, 0.0);
  }
  made.samples = 60;
  const SegyFile file = SegyFile::scan(folder.file("a.sgy", made.bytes()), {});
  EXPECT_EQ(file.report().traces, 4);
  EXPECT_EQ(all_samples(file)[60 * 3 + 5], 115.0f);
}

TEST(SegyLayout, ExtendedTextHeadersByCountAndByEndStanza) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(2, 2, 4);
  made.extended = {"((JJ ESEIS: one))", "more of it"};
  made.binary[3501] = std::string("\x01\x00", 2);
  made.binary[3505] = made.half(2);
  const SegyFile counted = SegyFile::scan(folder.file("a.sgy", made.bytes()), {});
  EXPECT_EQ(counted.report().traces, 4);
  EXPECT_EQ(counted.report().extended_text_header.size(), 80u);
  EXPECT_EQ(counted.report().extended_text_header[40], "more of it");
  EXPECT_EQ(all_samples(counted)[15], 113.0f);

  made.binary[3505] = made.half(-1);
  made.extended.push_back("((SEG: EndText))");
  const SegyFile ended = SegyFile::scan(folder.file("b.sgy", made.bytes()), {});
  EXPECT_EQ(ended.report().traces, 4);
  EXPECT_EQ(all_samples(ended), all_samples(counted));

  made.extended.pop_back();
  EXPECT_EQ(code_of_scan(folder.file("c.sgy", made.bytes())), ErrorCode::kFormat);
}

TEST(SegyLayout, ExtendedHeadersThatAreAnnouncedButNotThereAreIgnored) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(2, 2, 4);
  made.binary[3505] = made.half(-1);
  const SegyFile file = SegyFile::scan(folder.file("a.sgy", made.bytes()), {});
  EXPECT_EQ(file.report().traces, 4);
  EXPECT_EQ(all_samples(file)[15], 113.0f);
  ASSERT_EQ(file.report().warnings.size(), 1u);
  EXPECT_NE(file.report().warnings[0].find("no stanza"), std::string::npos);
}

TEST(SegyLayout, ATruncatedFileGivesItsWholeTracesAndSaysSo) {
  const ScratchFolder folder;
  const std::string whole = SampleSegy::grid(3, 3, 20).bytes();
  const SegyFile file = SegyFile::scan(folder.file("a.sgy", whole.substr(0, whole.size() - 50)), {});
  EXPECT_EQ(file.report().traces, 8);
  EXPECT_EQ(file.report().missing_bins, 1);
  ASSERT_FALSE(file.report().warnings.empty());
  EXPECT_NE(file.report().warnings[0].find("270 bytes"), std::string::npos) << file.report().warnings[0];
}

TEST(SegyLayout, AFileThatShrinksAfterTheScanIsCorrupt) {
  const ScratchFolder folder;
  const auto path = folder.file("a.sgy", SampleSegy::grid(3, 3, 20).bytes());
  const SegyFile file = SegyFile::scan(path, {});
  std::filesystem::resize_file(path, 4000);
  try {
    all_samples(file);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
  }
}

TEST(SegyLayout, WhatCannotBeReadIsRefusedWithTheReason) {
  const ScratchFolder folder;
  EXPECT_EQ(code_of_scan(folder / "none.sgy"), ErrorCode::kNotFound);
  EXPECT_EQ(code_of_scan(folder.path()), ErrorCode::kFormat);
  EXPECT_EQ(code_of_scan(folder.file("empty.sgy", "")), ErrorCode::kFormat);
  EXPECT_EQ(code_of_scan(folder.file("head.sgy", std::string(3600, '\0'))), ErrorCode::kUnsupported);
  EXPECT_EQ(code_of_scan(folder.file("zeros.sgy", std::string(9000, '\0'))), ErrorCode::kUnsupported);
  SampleSegy made = SampleSegy::grid(2, 2, 4);
  made.format = 4;
  EXPECT_EQ(code_of_scan(folder.file("gain.sgy", made.bytes())), ErrorCode::kUnsupported);
  made.format = 5;
  made.samples = 0;
  EXPECT_EQ(code_of_scan(folder.file("no-samples.sgy", made.bytes())), ErrorCode::kFormat);
  made.samples = 65535;
  EXPECT_EQ(code_of_scan(folder.file("absurd.sgy", made.bytes())), ErrorCode::kFormat);
  made.samples = 4;
  made.binary[3501] = std::string("\x02\x00", 2);
  made.binary[3269] = made.word(0x7FFFFFFF);
  EXPECT_EQ(code_of_scan(folder.file("huge.sgy", made.bytes())), ErrorCode::kFormat);
  EXPECT_FALSE(looks_like_segy(folder / "zeros.sgy"));
  EXPECT_FALSE(looks_like_segy(folder / "none.sgy"));
  EXPECT_FALSE(looks_like_segy(folder.file("text.txt", std::string(5000, 'x'))));
}

TEST(SegyLayout, AWrongFormatCodeCanBeOverruled) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(2, 2, 4);
  made.binary[3225] = made.half(0);
  Options options;
  options.format = 5;
  const SegyFile file = SegyFile::scan(folder.file("a.sgy", made.bytes()), options);
  EXPECT_EQ(all_samples(file)[3], 3.0f);
}

// Prefixes and many single-byte changes of a small file: read or refused, never a crash.
TEST(SegyLayout, DamagedFilesAreReadOrRefused) {
  const ScratchFolder folder;
  SampleSegy made = SampleSegy::grid(2, 2, 4);
  made.binary[3501] = std::string("\x02\x00", 2);
  const std::string whole = made.bytes();
  int read = 0, refused = 0;
  const auto attempt = [&](const std::string& content) {
    const auto path = folder.file("a.sgy", content);
    looks_like_segy(path);
    try {
      const SegyFile file = SegyFile::scan(path, {});
      if (file.geometry().box().count() < 100000) all_samples(file);
      ++read;
    } catch (const Error&) {
      ++refused;
    }
  };
  for (std::size_t size = 3500; size <= whole.size(); size += 13) attempt(whole.substr(0, size));
  for (std::size_t at = 3200; at < 4000; ++at) {
    for (const char value : {'\x7F', '\xFF'}) {
      std::string damaged = whole;
      damaged[at] = value;
      attempt(damaged);
    }
  }
  // Several bytes at once: the same again, most often within the headers.
  std::mt19937 random(19);
  for (int round = 0; round < rounds(200); ++round) {
    std::string damaged = whole;
    for (std::uint32_t n = 0; n <= random() % 8; ++n) {
      const std::size_t from = random() % 4 == 0 ? 0 : 3200;
      damaged[from + random() % (damaged.size() - from)] = static_cast<char>(random());
    }
    if (random() % 8 == 0) damaged.resize(3500 + random() % (damaged.size() - 3500));
    attempt(damaged);
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace footwall::formats::segy
