// What every way must give, and how it is found out without any of them.
#pragma once
#include <string>
#include <vector>

#include "engine/extract/extract.h"
#include "mpi/extract/survey_case.h"

namespace footwall::extract {

// Statistics of the faces, and the bytes of whole-face computations; `checksum` is of the statistics.
struct Expected {
  std::vector<FaceStatistics> faces;
  std::vector<FaceBlobs> blobs;
  std::uint64_t checksum = 0;
};

// By this rank alone, on one thread, with `minimum`. Not collective.
Expected alone(const Input& input, const ReadBox& read, const std::string& voxelizer,
               std::vector<std::string> compute);

// Holds every `step`th face of what was computed against definitions that share no code with the engine's
// sums: for `exact` with the oracle's voxels, of one in eight also contrast and offset; for `kaufman` with
// the definition's voxels. `rotated` has a definition up to rounding only (its unit test); here its voxels
// are those of one walk over the whole survey.
void expect_definition(const Expected& expected, const Input& input,
                       const std::function<float(const survey::Index&)>& value, const std::string& voxelizer,
                       const std::vector<std::string>& compute, std::size_t step = 1);

// At rank 0, byte by byte; nothing elsewhere. Names the first face that differs. Blobs are compared where the
// result has any.
void expect_same(const Result& got, const Expected& want);
// The same for some statistics, in the order of `want`.
void expect_same(const std::vector<FaceStatistics>& got, const std::vector<FaceStatistics>& want);

// The bytes of one face against those of the same computation for a face in `all`.
void expect_same_blob(const FaceBlobs& got, std::size_t face, const std::vector<FaceBlobs>& all,
                      std::size_t face_there);

}  // namespace footwall::extract
