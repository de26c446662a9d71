// The order in which a rank had best walk its faces: neighbours in space one after the other, so that the
// values they share are still in the cache.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

// A permutation of 0 .. faces.size() - 1 along a Morton curve through the centroids; ties by number. Which
// order is taken changes no result, only the time. O(n log n), a few ms for 10^5 faces.
std::vector<std::int64_t> ordered_by_place(std::span<const Face> faces);
// The same for those of the faces that are listed: a permutation of `which`.
std::vector<std::int64_t> ordered_by_place(std::span<const Face> faces, std::span<const std::int64_t> which);

}  // namespace footwall::extract
