#include "engine/session/part_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "engine/extract/face_numbers.h"
#include "mpi/session/small_job.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

Part some_part(int faces) {
  Part part{42, "Nørre fault", 0x123456789abcdefULL, small_faces(42, faces), {}, {}, {}};
  for (int n = 0; n < faces; ++n) {
    extract::FaceStatistics statistics;
    statistics.count = n * 1000000000LL;
    statistics.nulls = n;
    statistics.outside = static_cast<extract::Outside>(n % 3);
    double next = 0.1 * n;
    for (const extract::FaceNumber& each : extract::kFaceNumbers) statistics.*each.member = next += 1.1;
    statistics.mean = n == 3 ? extract::kUndefined : statistics.mean;
    statistics.variance = 1e300 / (n + 1);
    part.statistics.push_back(statistics);
    part.geometry.push_back(extract::face_geometry(small_geometry(), part.faces.back().triangle));
  }
  if (faces == 1) return part;
  for (const char* name : {"voxels", "lot"}) {
    extract::FaceBlobs& blobs = part.blobs.emplace_back(extract::FaceBlobs{name, {0}, {}});
    for (int n = 0; n < faces; ++n) {
      blobs.bytes.resize(blobs.bytes.size() + static_cast<std::size_t>(n % 5), static_cast<std::byte>(n));
      blobs.offsets.push_back(blobs.bytes.size());
    }
  }
  return part;
}

TEST(PartFile, ReadsBackAsItWasWritten) {
  const ScratchFolder folder;
  for (const int faces : {0, 1, 17}) {
    const Part written = some_part(faces);
    const auto path = part_path(folder.path(), written.fault);
    write_part(written, path);
    const Part read = read_part(path);
    EXPECT_EQ(read.fault, 42);
    EXPECT_EQ(read.name, written.name);
    EXPECT_EQ(read.hash, written.hash);
    EXPECT_EQ(read.faces, written.faces);
    ASSERT_EQ(read.blobs.size(), written.blobs.size());
    for (std::size_t n = 0; n < read.blobs.size(); ++n) {
      EXPECT_EQ(read.blobs[n].computation, written.blobs[n].computation);
      EXPECT_EQ(read.blobs[n].offsets, written.blobs[n].offsets);
      EXPECT_EQ(read.blobs[n].bytes, written.blobs[n].bytes);
    }
    ASSERT_EQ(read.statistics.size(), written.statistics.size());
    for (std::size_t n = 0; n < read.statistics.size(); ++n) {
      EXPECT_EQ(read.statistics[n].count, written.statistics[n].count);
      EXPECT_EQ(read.statistics[n].outside, written.statistics[n].outside);
      EXPECT_EQ(std::isnan(read.statistics[n].mean), n == 3);
      for (const extract::FaceNumber& each : extract::kFaceNumbers) {
        if (std::isnan(written.statistics[n].*each.member)) continue;
        EXPECT_EQ(read.statistics[n].*each.member, written.statistics[n].*each.member) << each.name;
      }
      EXPECT_EQ(read.geometry[n].area_voxels, written.geometry[n].area_voxels);
      EXPECT_TRUE(std::isnan(read.geometry[n].dip));
    }
  }
}

TEST(PartFile, ACutOrAlteredFileIsNotTakenForWhole) {
  const ScratchFolder folder;
  const auto path = part_path(folder.path(), 42);
  write_part(some_part(50), path);
  const std::string whole = read_whole_file(path, 1 << 24);
  for (std::size_t size = 0; size < whole.size(); size += whole.size() / 60 + 1) {
    std::ofstream(path, std::ios::binary).write(whole.data(), static_cast<std::streamsize>(size));
    EXPECT_THROW(read_part(path), Error) << size;
  }
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += 97) {
    std::string altered = whole;
    altered[at] = static_cast<char>(altered[at] ^ 0x20);
    std::ofstream(path, std::ios::binary).write(altered.data(), static_cast<std::streamsize>(altered.size()));
    try {
      const Part read = read_part(path);
      EXPECT_EQ(read.faces, some_part(50).faces) << at;  // bytes that nothing depends on
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
  std::filesystem::remove(path);
  EXPECT_THROW(read_part(path), Error);
}

}  // namespace
}  // namespace footwall::session
