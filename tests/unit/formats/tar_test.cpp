#include "storage/formats/tar.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <vector>

#include "rounds.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "unit/formats/hostile_tar.h"

namespace footwall::formats {
namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

class Tar : public ::testing::Test {
 protected:
  void write(const Files& files) const {
    TarWriter tar(path_);
    for (const auto& [name, content] : files) {
      tar.begin(name, static_cast<std::int64_t>(content.size()));
      tar.write(std::as_bytes(std::span(content)));
    }
    tar.close();
  }
  Files read() const {
    TarReader tar(path_);
    TarReader::Entry entry;
    Files files;
    while (tar.next(entry)) {
      std::string content;
      tar.read([&](std::span<const std::byte> bytes) {
        content.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      });
      files.emplace_back(entry.name, content);
    }
    return files;
  }
  Error error_of_reading(const std::string& archive) const {
    folder_.file("a.tar", archive);
    try {
      read();
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "expected an error";
    return {ErrorCode::kInternal, "no error"};
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "a.tar";
};

TEST_F(Tar, WhatIsWrittenIsReadBack) {
  const Files files{{"p.footwall", std::string(70'000, 'x')},
                    {"p.footwall.volumes/st\xC3\xB6rung.h5", std::string("\0\1\2", 3)},
                    {"p.footwall.volumes/empty", ""},
                    {std::string(90, 'd') + "/" + std::string(150, 'n'), "long names need pax"}};
  write(files);
  EXPECT_EQ(read(), files);
}

TEST_F(Tar, AnyTarReadsIt) {
  write({{"st\xC3\xB6rung.footwall", "hello"}, {"st\xC3\xB6rung.footwall.volumes/v.h5", "volume"}});
  const std::string command = "cd " + folder_.path().string() + " && tar xf a.tar";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(content_of(folder_ / "st\xC3\xB6rung.footwall.volumes/v.h5"), "volume");
}

TEST_F(Tar, AFileMustBeAsLongAsAnnounced) {
  TarWriter tar(path_);
  tar.begin("a", 3);
  EXPECT_THROW(tar.write(std::as_bytes(std::span("four", 4))), Error);
  EXPECT_THROW(tar.begin("b", 1), Error);
  EXPECT_THROW(tar.close(), Error);
}

TEST_F(Tar, NamesThatLeaveTheFolderAreRefusedOnBothSides) {
  const std::string control = "a\x1b[2J";
  for (const std::string& name : {std::string("/etc/passwd"), std::string("../up"), std::string("a/../../up"),
                                  std::string("a//b"), std::string("a/./b"), std::string("a\\b"), control,
                                  std::string("bad\xff"), std::string(2000, 'n'), std::string()}) {
    {
      TarWriter tar(path_);
      EXPECT_THROW(tar.begin(name, 0), Error) << name;
    }
    if (name.empty() || name.size() > 100) continue;
    const Error error = error_of_reading(tar_entry(name, "x") + tar_end());
    EXPECT_EQ(error.code(), ErrorCode::kFormat) << name << ": " << error.what();
    EXPECT_EQ(std::string(error.what()).find('\x1b'), std::string::npos);
  }
}

TEST_F(Tar, OnlyPlainFilesAreRead) {
  for (const char type : {'1', '2', '3', '4', '6'}) {
    const Error error = error_of_reading(tar_entry("a", "", type, "/etc/passwd") + tar_end());
    EXPECT_EQ(error.code(), ErrorCode::kFormat) << type;
  }
  EXPECT_EQ(error_of_reading(tar_entry("a", "1") + tar_entry("./a", "2") + tar_end()).code(),
            ErrorCode::kFormat);
  // A sparse file of a terabyte in half a kilobyte.
  const std::string pax =
      "22 GNU.sparse.major=1\n22 GNU.sparse.minor=0\n33 GNU.sparse.realsize=1099511627776\n";
  const std::string map = std::string("1\n0\n0\n");
  EXPECT_THROW(
      {
        folder_.file("a.tar",
                     tar_entry("x", pax, 'x') + tar_entry("a", map + std::string(506, '\0')) + tar_end());
        read();
      },
      Error);
  folder_.file("a.tar", tar_entry("./", "", '5') + tar_entry("./a", "plain") + tar_end());
  EXPECT_EQ(read(), (Files{{"a", "plain"}}));
}

TEST_F(Tar, SizesThatLieEndInAnError) {
  EXPECT_EQ(error_of_reading(tar_entry("a", "x", '0', "", 1'000'000'000) + tar_end()).code(),
            ErrorCode::kCorrupt);
  const std::string whole = tar_entry("a", std::string(2000, 'x')) + tar_entry("b", "y") + tar_end();
  for (const std::size_t cut : {std::size_t{600}, std::size_t{1700}, std::size_t{2560 + 100}})
    EXPECT_EQ(error_of_reading(whole.substr(0, cut)).code(), ErrorCode::kCorrupt) << cut;
}

TEST_F(Tar, WhatIsNoTarIsSaid) {
  EXPECT_EQ(error_of_reading("").code(), ErrorCode::kFormat);
  EXPECT_EQ(error_of_reading(std::string(5000, 'x')).code(), ErrorCode::kFormat);
  EXPECT_NE(error_of_reading("\x1f\x8b" + std::string(1000, 'x')).hint().find("gunzip"), std::string::npos);
  EXPECT_THROW(TarReader(folder_ / "nothing"), Error);
  EXPECT_THROW(TarReader(folder_.path()), Error);
}

TEST_F(Tar, DamagedArchivesAreReadOrRefused) {
  write({{"a", std::string(3000, 'a')}, {std::string(150, 'n'), "b"}});
  const std::string whole = content_of(path_);
  std::uint64_t state = 7;
  for (int n = 0; n < rounds(200); ++n) {
    std::string bytes = whole;
    for (int k = 0; k < 3; ++k) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      bytes[(state >> 33) % bytes.size()] = static_cast<char>(state >> 56);
    }
    folder_.file("a.tar", bytes.substr(0, bytes.size() - (state >> 40) % 700));
    try {
      read();
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::kInternal) << error.what();
    }
  }
}

}  // namespace
}  // namespace footwall::formats
