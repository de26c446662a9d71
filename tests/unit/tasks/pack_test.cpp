#include "engine/tasks/pack.h"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/tasks/new_project.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/formats/tar.h"
#include "unit/formats/hostile_tar.h"

namespace footwall::tasks {
namespace {

class Pack : public ::testing::Test {
 protected:
  Pack() { new_synthetic_project(path_, "faulted", {12, 11, 16}, 5, 10, {}); }

  Packed pack(const PackOptions& options = {}) const {
    return pack_project(project::Project::open(path_, project::OpenMode::kRead), archive_, options, {});
  }
  Unpacked unpack() const {
    std::filesystem::create_directory(elsewhere_);
    return unpack_project(archive_, elsewhere_, {});
  }
  template <class Call>
  Error error_of(const Call& call) const {
    try {
      call();
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "expected an error";
    return {ErrorCode::kInternal, "no error"};
  }
  static std::ptrdiff_t files_in(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder), {});
  }
  // The archive's entries, to be put together anew.
  std::vector<std::pair<std::string, std::string>> entries() const {
    formats::TarReader tar(archive_);
    formats::TarReader::Entry entry;
    std::vector<std::pair<std::string, std::string>> all;
    while (tar.next(entry)) {
      all.emplace_back(entry.name, "");
      tar.read([&](std::span<const std::byte> bytes) {
        all.back().second.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      });
    }
    return all;
  }
  void write_archive(const std::vector<std::pair<std::string, std::string>>& entries) const {
    std::string bytes;
    for (const auto& [name, content] : entries) bytes += formats::tar_entry(name, content);
    folder_.file("p.footwall.tar", bytes + formats::tar_end());
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "p.footwall";
  std::filesystem::path archive_ = folder_ / "p.footwall.tar";
  std::filesystem::path elsewhere_ = folder_ / "elsewhere";
};

TEST_F(Pack, AFolderThatCannotBeWrittenIsNamed) {
  archive_ = "/proc/p.footwall.tar";  // not even root writes there
  const Error error = error_of([&] { pack(); });
  EXPECT_NE(error.message().find("/proc"), std::string::npos) << error.message();
}

TEST_F(Pack, WhatIsUnpackedElsewhereIsTheSame) {
  const auto before = files_in(folder_.path());
  const Packed packed = pack();
  EXPECT_EQ(packed.volumes, std::vector<std::string>{"amplitude"});
  EXPECT_EQ(files_in(folder_.path()), before + 1) << "only the archive is left";
  const Unpacked unpacked = unpack();
  EXPECT_EQ(files_in(elsewhere_), 2);
  const auto original = project::Project::open(path_, project::OpenMode::kRead);
  const auto copy = project::Project::open(unpacked.project, project::OpenMode::kWrite);
  EXPECT_EQ(copy.survey(), original.survey());
  ASSERT_EQ(copy.faults().size(), original.faults().size());
  EXPECT_EQ(copy.history().size(), original.history().size());
  EXPECT_TRUE(copy.missing().empty());
  EXPECT_EQ(content_of(copy.volume_path(copy.volume(""))),
            content_of(original.volume_path(original.volume(""))));
  EXPECT_EQ(error_of([&] { unpack(); }).code(), ErrorCode::kInvalid) << "nothing is written over";
  EXPECT_EQ(error_of([&] { pack(); }).code(), ErrorCode::kInvalid);
}

TEST_F(Pack, AProjectThatIsBeingWrittenIsPackedAsItIs) {
  auto writer = project::Project::open(path_, project::OpenMode::kWrite);
  writer.edit("add", [](project::Interpretation& it) { it.add_fault("new"); });
  pack();
  const auto copy = project::Project::open(unpack().project, project::OpenMode::kRead);
  EXPECT_EQ(copy.fault("new").name, "new");
}

TEST_F(Pack, AVolumeThatLiesElsewhereComesAlong) {
  auto project = project::Project::open(path_, project::OpenMode::kWrite);
  const auto volume = project.volume("");
  const auto moved = folder_ / "st\xC3\xB6rung.h5";
  std::filesystem::rename(project.volume_path(volume), moved);
  EXPECT_EQ(error_of([&] { pack(); }).code(), ErrorCode::kNotFound);
  PackOptions without;
  without.without_missing = true;
  EXPECT_EQ(pack(without).missing, std::vector<std::string>{"amplitude"});
  EXPECT_EQ(unpack().missing, std::vector<std::string>{"amplitude"});
  std::filesystem::remove_all(elsewhere_);
  std::filesystem::remove(archive_);

  project.relink("amplitude", moved);
  project.close();
  pack();
  std::filesystem::remove(moved);
  const auto copy = project::Project::open(unpack().project, project::OpenMode::kRead);
  EXPECT_TRUE(copy.missing().empty());
  EXPECT_EQ(copy.volume("").file, "st\xC3\xB6rung.h5");
}

TEST_F(Pack, ADamagedVolumeIsNotPacked) {
  const auto project = project::Project::open(path_, project::OpenMode::kRead);
  const auto file = project.volume_path(project.volume(""));
  std::string bytes = content_of(file);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(file, std::ios::binary) << bytes;
  const auto before = files_in(folder_.path());
  EXPECT_EQ(error_of([&] { pack(); }).code(), ErrorCode::kCorrupt);
  EXPECT_EQ(files_in(folder_.path()), before);
}

TEST_F(Pack, ACancelLeavesNothing) {
  const auto project = project::Project::open(path_, project::OpenMode::kRead);
  const auto before = files_in(folder_.path());
  for (const double when : {0.0, 0.04, 0.5, 0.99}) {
    JobContext* self = nullptr;
    JobContext job([&](const Progress& progress) {
      if (progress.fraction >= when) self->cancel();
    });
    self = &job;
    EXPECT_EQ(error_of([&] { pack_project(project, archive_, {}, job); }).code(), ErrorCode::kCancelled)
        << when;
    EXPECT_EQ(files_in(folder_.path()), before);
  }
  pack();
  std::filesystem::create_directory(elsewhere_);
  for (const double when : {0.0, 0.3, 0.8}) {
    JobContext* self = nullptr;
    JobContext job([&](const Progress& progress) {
      if (progress.fraction >= when) self->cancel();
    });
    self = &job;
    EXPECT_EQ(error_of([&] { unpack_project(archive_, elsewhere_, job); }).code(), ErrorCode::kCancelled)
        << when;
    EXPECT_EQ(files_in(elsewhere_), 0);
  }
}

TEST_F(Pack, AnArchiveThatIsCutAnywhereIsRefused) {
  pack();
  const std::string whole = content_of(archive_);
  for (const std::size_t tenth : {0U, 1U, 3U, 5U, 7U, 9U}) {
    folder_.file("p.footwall.tar", whole.substr(0, whole.size() * tenth / 10));
    const Error error = error_of([&] { unpack(); });
    EXPECT_TRUE(error.code() == ErrorCode::kCorrupt || error.code() == ErrorCode::kFormat) << error.what();
    EXPECT_EQ(files_in(elsewhere_), 0);
  }
  // Between two entries, where tar itself sees nothing wrong.
  folder_.file("p.footwall.tar", whole);
  auto parts = entries();
  parts.pop_back();
  write_archive(parts);
  EXPECT_NE(std::string(error_of([&] { unpack(); }).what()).find("cut short"), std::string::npos);
}

TEST_F(Pack, AHostileArchiveWritesNothing) {
  pack();
  const auto whole = entries();
  ASSERT_EQ(whole.size(), 3U);
  const auto refused = [&](const std::vector<std::pair<std::string, std::string>>& parts, ErrorCode code) {
    write_archive(parts);
    const Error error = error_of([&] { unpack(); });
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(files_in(elsewhere_), 0) << error.what();
  };
  refused({{"../p.footwall", whole[0].second}}, ErrorCode::kFormat);
  refused({whole[0], {"p.footwall.volumes/../../x", "x"}, whole[2]}, ErrorCode::kFormat);
  refused({whole[0], {".bashrc", "x"}, whole[1], whole[2]}, ErrorCode::kFormat);
  refused({whole[0], {"p.footwall.volumes/a/b", "x"}, whole[2]}, ErrorCode::kFormat);
  refused({whole[0], whole[1], whole[2], {"p.footwall.volumes/late", "x"}}, ErrorCode::kFormat);
  refused({whole[0], whole[2]}, ErrorCode::kCorrupt);
  refused({whole[0], whole[1], {whole[2].first, "[[[[["}}, ErrorCode::kFormat);
  refused({{"p.footwall", "not a project"}, whole[1], whole[2]}, ErrorCode::kCorrupt);
  auto altered = whole;
  altered[1].second[altered[1].second.size() / 2] ^= 1;
  refused(altered, ErrorCode::kCorrupt);
  write_archive(whole);
  std::filesystem::create_symlink(folder_ / "nowhere", elsewhere_ / "p.footwall");
  EXPECT_EQ(error_of([&] { unpack(); }).code(), ErrorCode::kInvalid) << "a link stands in the way";
}

}  // namespace
}  // namespace footwall::tasks
