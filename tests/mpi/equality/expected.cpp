#include "mpi/equality/expected.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "engine/extract/face_rows.h"
#include "engine/verify/contrast_by_definition.h"
#include "engine/verify/raster_by_definition.h"
#include "engine/verify/statistics_by_definition.h"
#include "engine/verify/voxel_oracle.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"
#include "mpi/extract/same_bits.h"

namespace footwall::extract {
namespace {

// The definition of contrast and offset takes seconds for a few large faces.
constexpr std::size_t kProbesOneIn = 8;

bool has_area(const survey::LatticeTriangle& t) {
  const auto edge = [&](std::size_t to) {
    return survey::Index{t[to].i - t[0].i, t[to].j - t[0].j, t[to].k - t[0].k};
  };
  const survey::Index a = edge(1), b = edge(2);
  return a[1] * b[2] != a[2] * b[1] || a[2] * b[0] != a[0] * b[2] || a[0] * b[1] != a[1] * b[0];
}

std::vector<survey::Index> voxels_of(const survey::LatticeTriangle& triangle, const survey::Index& dims,
                                     const std::string& voxelizer) {
  const survey::Box whole{{0, 0, 0}, dims};
  const survey::Box box = survey::intersection(survey::grown(voxelize::bounding_voxels(triangle), 1), whole);
  if (box.empty()) return {};
  if (voxelizer == "exact") return verify::voxels_by_definition(triangle, box);
  if (voxelizer == "kaufman" && has_area(triangle)) return verify::kaufman_by_definition(triangle, box);
  FaceRows rows;
  voxelize::make_voxelizer(voxelizer)->rows(triangle, whole, rows);
  std::vector<survey::Index> voxels;
  rows.for_each([&](const survey::Index& p) { voxels.push_back(p); });
  return voxels;
}

Outside where(const survey::LatticeTriangle& triangle, const survey::Index& dims, bool touched) {
  const bool inside = std::all_of(triangle.begin(), triangle.end(), [&](const survey::LatticePoint& p) {
    const survey::Index at{p.i, p.j, p.k};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < -128 || at[axis] > 256 * dims[axis] - 128) return false;
    }
    return true;
  });
  return inside ? Outside::kInside : touched ? Outside::kPartly : Outside::kWholly;
}

// Bit by bit, with NaNs: whatever computed them, there is one that means undefined.
bool same_bytes(const FaceStatistics& a, const FaceStatistics& b) {
  const auto numbers = [](const FaceStatistics& f) {
    return std::array{f.mean,          f.variance, f.min,           f.max,
                      f.discontinuity, f.contrast, f.offset_voxels, f.offset_score};
  };
  const auto mine = numbers(a), others = numbers(b);
  return a.count == b.count && a.nulls == b.nulls && a.outside == b.outside &&
         std::memcmp(mine.data(), others.data(), sizeof(mine)) == 0;
}

}  // namespace

Expected alone(const Input& input, const ReadBox& read, const std::string& voxelizer,
               std::vector<std::string> compute) {
  Options options;
  options.exchange = "minimum";
  options.balance = "none";
  options.voxelizer = voxelizer;
  options.compute = std::move(compute);
  options.snr = 40;
  Result result = extract_all(comm::Communicator(MPI_COMM_SELF), input, options, read);
  return {std::move(result.faces), std::move(result.blobs), result.report.checksum};
}

void expect_definition(const Expected& expected, const Input& input,
                       const std::function<float(const survey::Index&)>& value, const std::string& voxelizer,
                       const std::vector<std::string>& compute, std::size_t step) {
  const auto asked = [&](const char* name) { return std::count(compute.begin(), compute.end(), name) > 0; };
  ASSERT_EQ(expected.faces.size(), input.faces.size());
  std::map<std::int64_t, std::vector<Face>> faults;
  for (const Face& face : input.faces) faults[face.fault].push_back(face);
  for (std::size_t n = 0; n < input.faces.size(); n += step) {
    SCOPED_TRACE(testing::Message() << "face " << n << " by definition");
    const survey::LatticeTriangle& triangle = input.faces[n].triangle;
    const auto voxels = voxels_of(triangle, input.dims, voxelizer);
    FaceStatistics want = verify::statistics_by_definition(voxels, input.dims, value, input.max_abs,
                                                           where(triangle, input.dims, !voxels.empty()));
    const FaceStatistics& got = expected.faces[n];
    if (!asked("discontinuity")) want.discontinuity = kUndefined;
    verify::ContrastByDefinition probed{got.contrast, got.offset_voxels, got.offset_score};
    if (asked("contrast") && voxelizer == "exact" && n % (step * kProbesOneIn) == 0) {
      probed = verify::contrast_by_definition(triangle, input.dims, value, input.max_abs,
                                              verify::side_by_definition(faults.at(input.faces[n].fault)));
    }
    if (asked("contrast")) want.contrast = probed.contrast;
    if (asked("offset")) {
      want.offset_voxels = probed.offset_voxels;
      want.offset_score = probed.offset_score;
    }
    expect_equal(got, want);
  }
}

void expect_same(const std::vector<FaceStatistics>& got, const std::vector<FaceStatistics>& want) {
  ASSERT_EQ(got.size(), want.size());
  std::size_t wrong = 0, first = 0;
  for (std::size_t n = got.size(); n-- > 0;) {
    if (same_bytes(got[n], want[n])) continue;
    ++wrong;
    first = n;
  }
  if (wrong == 0) return;
  ADD_FAILURE() << wrong << " of " << got.size() << " faces differ, first face " << first;
  expect_equal(got[first], want[first]);
}

void expect_same_blob(const FaceBlobs& got, std::size_t face, const std::vector<FaceBlobs>& all,
                      std::size_t face_there) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const FaceBlobs& each) { return each.computation == got.computation; });
  ASSERT_NE(found, all.end()) << got.computation;
  const auto mine = got.of(face), others = found->of(face_there);
  EXPECT_TRUE(std::equal(mine.begin(), mine.end(), others.begin(), others.end()))
      << got.computation << " of face " << face;
}

void expect_same(const Result& got, const Expected& want) {
  if (got.faces.empty() && !want.faces.empty()) FAIL() << "no statistics";
  expect_same(got.faces, want.faces);
  EXPECT_EQ(got.report.checksum, want.checksum);
  for (const FaceBlobs& blobs : got.blobs) {
    ASSERT_EQ(blobs.offsets.size(), want.faces.size() + 1) << blobs.computation;
    for (std::size_t n = 0; n < want.faces.size(); ++n) expect_same_blob(blobs, n, want.blobs, n);
  }
}

}  // namespace footwall::extract
