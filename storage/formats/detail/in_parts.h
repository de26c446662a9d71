// Goes through a TriangleSource's numbers part by part.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/triangle_source.h"

namespace footwall::formats::detail {

// fill(first, span) fills a part, take(span) gets it.
template <class Value, class Fill, class Take>
void in_parts(std::uint64_t count, Fill&& fill, Take&& take) {
  std::vector<Value> part(static_cast<std::size_t>(std::min(count, TriangleSource::kPart)));
  for (std::uint64_t first = 0; first < count; first += TriangleSource::kPart) {
    const std::span<Value> some =
        std::span(part).first(static_cast<std::size_t>(std::min(TriangleSource::kPart, count - first)));
    fill(first, some);
    take(std::span<const Value>(some));
  }
}

// Records of a binary file, one part at a time.
class Records {
 public:
  void clear() { bytes_.clear(); }
  template <class Value>
  void put(const Value& value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

// put(records, corners) for each triangle, in their order; what it puts is written.
template <class Put>
void write_triangles(OutputFile& out, const TriangleSource& source, const JobContext& job, Put&& put) {
  using Corners = std::array<std::uint32_t, 3>;
  Records records;
  in_parts<Corners>(source.triangles, source.corners, [&](std::span<const Corners> part) {
    job.check();
    records.clear();
    for (const Corners& corners : part) put(records, corners);
    out.write(records.bytes());
  });
}

}  // namespace footwall::formats::detail
