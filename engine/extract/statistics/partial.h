// What a rank knows of a face after folding its own voxels, and its compact form for sending.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "engine/extract/face.h"
#include "engine/extract/statistics/discontinuity.h"
#include "engine/extract/statistics/moments.h"

namespace footwall::extract {

struct Partial {
  Moments moments;
  Discontinuity discontinuity;

  std::int64_t voxels() const { return moments.count + moments.nulls; }
  void merge(const Partial& other) {
    moments.merge(other.moments);
    discontinuity.merge(other.discontinuity);
  }
};

// Appends the face's number and its partial sums: integers without their leading and trailing zero bytes,
// about 50 bytes for seismic amplitudes, 70 with discontinuity.
void encode(std::int64_t face, const Partial& partial, std::vector<std::byte>& out);
// The most bytes that a record can have: what both sides know of it beforehand.
std::size_t most_bytes(bool with_discontinuity);
// Takes one record off the front of `bytes`. Throws Error kInternal where they are not what encode() wrote.
std::int64_t decode(std::span<const std::byte>& bytes, Partial& partial);

// The face's statistics; inside_survey: whether the whole triangle lies in the survey's box. A discontinuity
// that was not folded is NaN.
FaceStatistics finish(const Partial& partial, bool inside_survey);

}  // namespace footwall::extract
