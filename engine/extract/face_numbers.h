// The numbers of a face by name. What goes over all of them goes over this table: the checksum, part files,
// the summary of a fault, and tests that compare bits.
#pragma once
#include <array>
#include <string_view>

#include "engine/extract/face.h"

namespace footwall::extract {

struct FaceNumber {
  std::string_view name;
  double FaceStatistics::*member;
  bool of_faults;  // defined for a whole fault, too
};

// The order is that of the words of a checksum.
inline constexpr std::array kFaceNumbers{FaceNumber{"mean", &FaceStatistics::mean, true},
                                         FaceNumber{"variance", &FaceStatistics::variance, true},
                                         FaceNumber{"min", &FaceStatistics::min, true},
                                         FaceNumber{"max", &FaceStatistics::max, true},
                                         FaceNumber{"discontinuity", &FaceStatistics::discontinuity, true},
                                         FaceNumber{"contrast", &FaceStatistics::contrast, false},
                                         FaceNumber{"offset_voxels", &FaceStatistics::offset_voxels, false},
                                         FaceNumber{"offset_score", &FaceStatistics::offset_score, false}};

// count, nulls and outside are what they are; every double has its row.
static_assert(sizeof(FaceStatistics) == (3 + kFaceNumbers.size()) * sizeof(double));

}  // namespace footwall::extract
