#include "engine/session/job.h"

#include <gtest/gtest.h>

#include "mpi/session/small_job.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

ErrorCode code_of_reading(const std::filesystem::path& path) {
  try {
    read_job(path);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(Job, ReadsBackAsItWasWritten) {
  const ScratchFolder folder;
  Job written = write_small_job(folder.path());
  written.options.compute = {"variance"};
  written.options.threads = 3;
  written.velocity = 2500;
  written.volume_name = "near";
  written.volume_origin = {4, 0, 7};
  written.run = "night run";
  written.faults[1].revision = 12;
  written.geometry.assumed = {"the interval"};
  write_job(written, folder.path() / "JOB.json");
  const Job read = read_job(folder.path() / "JOB.json");
  EXPECT_EQ(read.geometry, written.geometry);
  EXPECT_EQ(read.options, written.options);
  EXPECT_EQ(read.velocity, written.velocity);
  EXPECT_EQ(read.volume, folder.path() / "volume.h5");
  EXPECT_EQ(read.output, folder.path() / "out");
  ASSERT_EQ(read.faults.size(), 3U);
  EXPECT_EQ(read.faults[1].name, "Klüft 2");
  EXPECT_EQ(read.faults[1].revision, 12);
  EXPECT_EQ(read.volume_name, "near");
  EXPECT_EQ(read.volume_origin, (survey::Index{4, 0, 7}));
  EXPECT_EQ(read.run, "night run");
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(read.faults[n].faces, written.faults[n].faces);
}

TEST(Job, ThePartHashKnowsWhatChangesNumbers) {
  const ScratchFolder folder;
  const Job job = write_small_job(folder.path());
  const std::uint64_t hash = part_hash(job, job.faults[0]);
  Job same = job;
  same.options.exchange = "minimum";
  same.options.threads = 9;
  same.output = "elsewhere";
  same.geometry.crs = "EPSG:23031";
  same.geometry.assumed = {"the interval"};
  same.faults[0].name = "renamed";
  same.faults[0].revision = 5;
  EXPECT_EQ(part_hash(same, same.faults[0]), hash);
  EXPECT_EQ(job_hash(same), job_hash(job));
  Job other = job;
  other.faults[0].faces[3].triangle[1].k += 1;
  EXPECT_NE(part_hash(other, other.faults[0]), hash);
  other = job;
  other.volume_checksum = "0000000000000000";
  EXPECT_NE(part_hash(other, other.faults[0]), hash);
  other = job;
  other.velocity = 2000;
  EXPECT_NE(part_hash(other, other.faults[0]), hash);
}

TEST(Job, DamageIsReportedAndNeverCrashes) {
  const ScratchFolder folder;
  write_small_job(folder.path());
  const auto json_path = folder.path() / "JOB.json";
  const auto faces_path = folder.path() / "JOB.faces";
  const std::string json = read_whole_file(json_path, 1 << 20);
  const std::string faces = read_whole_file(faces_path, 1 << 20);

  for (std::size_t size = 0; size + 2 < json.size(); size += 61) {
    write_whole_file(json_path, json.substr(0, size));
    EXPECT_EQ(code_of_reading(json_path), ErrorCode::kFormat) << size;
  }
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = json;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    write_whole_file(json_path, text.replace(at, from.size(), to));
    return code_of_reading(json_path);
  };
  EXPECT_EQ(with("\"footwall_job\": 1", "\"footwall_job\": 2"), ErrorCode::kUnsupported);
  EXPECT_EQ(with("\"samples\": 30", "\"samples\": \"30\""), ErrorCode::kFormat);
  EXPECT_EQ(with("\"samples\": 30", "\"samples\": -30"), ErrorCode::kInvalid);
  EXPECT_EQ(with("\"faces\": 40", "\"faces\": 400000000000"), ErrorCode::kFormat);
  EXPECT_EQ(with("\"faces\": 40", "\"faces\": 39"), ErrorCode::kFormat);
  write_whole_file(json_path, json);

  write_whole_file(faces_path, faces.substr(0, faces.size() - 9));
  EXPECT_EQ(code_of_reading(json_path), ErrorCode::kCorrupt);
  std::string altered = faces;
  altered[100] = static_cast<char>(altered[100] ^ 1);
  write_whole_file(faces_path, altered);
  EXPECT_EQ(code_of_reading(json_path), ErrorCode::kCorrupt);
  std::filesystem::remove(faces_path);
  EXPECT_EQ(code_of_reading(json_path), ErrorCode::kNotFound);
  EXPECT_EQ(code_of_reading(folder.path() / "none.json"), ErrorCode::kNotFound);
}

}  // namespace
}  // namespace footwall::session
