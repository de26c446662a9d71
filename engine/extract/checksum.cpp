// One number that tells whether two extractions gave the same.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

#include "engine/extract/extract.h"
#include "engine/extract/face_numbers.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"

namespace footwall::extract {
namespace {

bool before(const Face& a, const Face& b) {
  return std::tie(a.fault, a.owner, a.n) < std::tie(b.fault, b.owner, b.n);
}

// The places of the faces by identity, equal ones as they come; most lists are in order already.
std::vector<std::size_t> order_of(std::span<const Face> faces) {
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (std::is_sorted(faces.begin(), faces.end(), before)) return order;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return before(faces[a], faces[b]); });
  return order;
}

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(std::isnan(value) ? kUndefined : value);
}

}  // namespace

std::uint64_t checksum_of(std::span<const Face> faces, std::span<const FaceStatistics> statistics) {
  static_assert(std::endian::native == std::endian::little);
  require(faces.size() == statistics.size(), "statistics of every face");
  Hasher hasher;
  for (const std::size_t n : order_of(faces)) {
    const Face& face = faces[n];
    const FaceStatistics& s = statistics[n];
    constexpr std::size_t kWhole = 6;  // words that are no doubles
    std::array<std::uint64_t, kWhole + kFaceNumbers.size()> words{
        static_cast<std::uint64_t>(face.fault),
        static_cast<std::uint64_t>(face.owner),
        static_cast<std::uint64_t>(std::int64_t{face.n}),
        static_cast<std::uint64_t>(s.count),
        static_cast<std::uint64_t>(s.nulls),
        static_cast<std::uint64_t>(s.outside)};
    for (std::size_t v = 0; v < kFaceNumbers.size(); ++v) words[kWhole + v] = bits(s.*kFaceNumbers[v].member);
    hasher.add(std::as_bytes(std::span(words)));
  }
  return hasher.value();
}

}  // namespace footwall::extract
