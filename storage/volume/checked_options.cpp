#include "storage/volume/checked_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "storage/base/error.h"
#include "storage/volume/description.h"

namespace footwall::volume {
namespace {

constexpr std::int64_t kDefaultSide = 32;
constexpr std::int64_t kDefaultBlockBytes = std::int64_t{64} << 20;
constexpr std::int64_t kMostBlockBytes = std::int64_t{1} << 30;

std::int64_t block_bytes(const survey::Index& dims, const survey::Index& chunk) {
  return chunk[0] * chunk[1] * (dims[2] + chunk[2]) * static_cast<std::int64_t>(sizeof(float));
}

survey::Index checked_chunk(const WriteOptions& options) {
  const survey::Index dims = options.geometry.dims();
  survey::Index chunk = options.chunk.value_or(default_chunk(dims));
  for (int axis = 0; axis < 3; ++axis) {
    if (chunk[axis] < 1) throw Error(ErrorCode::kInvalid, "a chunk needs at least one voxel on each axis");
    chunk[axis] = std::min(chunk[axis], dims[axis]);
  }
  // Sides are at most 2^23, so that only the product of all three could overflow.
  if (chunk[0] * chunk[1] > kMostBlockBytes / 4 || block_bytes(dims, chunk) > kMostBlockBytes) {
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("chunks of {} x {} x {} make blocks of more than 1 GiB", chunk[0], chunk[1], chunk[2]),
        "use fewer inlines and crosslines a chunk");
  }
  return chunk;
}

}  // namespace

survey::Index default_chunk(const survey::Index& dims) {
  survey::Index chunk;
  for (int axis = 0; axis < 3; ++axis) chunk[axis] = std::min(dims[axis], kDefaultSide);
  while (block_bytes(dims, chunk) > kDefaultBlockBytes && std::max(chunk[0], chunk[1]) > 8) {
    std::int64_t& longer = chunk[0] > chunk[1] ? chunk[0] : chunk[1];
    longer = std::max<std::int64_t>(8, longer / 2);
  }
  return chunk;
}

VolumeInfo checked(const WriteOptions& options) {
  options.geometry.validate();
  VolumeInfo info;
  info.geometry = options.geometry;
  info.dims = options.geometry.dims();
  info.origin = options.origin;
  if (options.null_value && !std::isnan(*options.null_value)) info.null_value = options.null_value;
  info.role = options.role;
  info.high_is_fault = options.high_is_fault;
  info.source = options.source;
  info.provenance_json = options.provenance_json;
  info.chunk = checked_chunk(options);
  describe(info);
  return info;
}

}  // namespace footwall::volume
