#include "engine/isosurface/detail/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/error.h"

namespace footwall::isosurface::detail {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::kInvalid, message);
}

void check_field(const Field& field) {
  std::uint64_t samples = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t size = field.size[axis];
    const std::int64_t origin = field.origin[axis];
    if (size < 1 || origin < 0 || origin > field.volume_size[axis] - size) {
      refuse(fmt::format("samples {} to {} do not lie in a volume of {} on axis {}", origin,
                         origin + size - 1, field.volume_size[axis], axis));
    }
    samples *= static_cast<std::uint64_t>(size);
  }
  if (samples != field.values.size()) {
    refuse(fmt::format("a field of {} x {} x {} samples with {} values", field.size[0], field.size[1],
                       field.size[2], field.values.size()));
  }
  // Places inside three planes are 32-bit numbers, and positions float32.
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max() / 4;
  constexpr std::int64_t kLongest = std::int64_t{1} << 24;
  if (field.size[1] * field.size[2] > kMost ||
      *std::max_element(field.volume_size.begin(), field.volume_size.end()) > kLongest) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("an isosurface in planes of {} x {} samples", field.size[1], field.size[2]),
                fmt::format("at most {} samples a plane, and {} along an axis", kMost, kLongest));
  }
}

void check_bricks(const Field& field, const Bricks& bricks) {
  std::int64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (bricks.dims[axis] != std::max<std::int64_t>(1, (field.volume_size[axis] + 6) / 8)) {
      refuse(fmt::format("{} bricks on axis {} for {} samples", bricks.dims[axis], axis,
                         field.volume_size[axis]));
    }
    count *= bricks.dims[axis];
  }
  const auto entries = static_cast<std::size_t>(count);
  if (bricks.min.size() != entries || bricks.max.size() != entries || bricks.has_null.size() != entries) {
    refuse(fmt::format("the tables of {} bricks have other sizes", entries));
  }
}

}  // namespace

void check_arguments(const Field& field, float isovalue, const ExtractOptions& options) {
  check_field(field);
  if (!std::isfinite(isovalue)) refuse(fmt::format("{} is no isovalue", isovalue));
  if (options.threads < 1) refuse(fmt::format("{} threads", options.threads));
  if (options.cells && !options.cells->empty() &&
      survey::intersection(*options.cells, cells_of(field)) != *options.cells) {
    refuse("the cells to march lie outside of the field");
  }
  if (options.bricks != nullptr) check_bricks(field, *options.bricks);
  if (options.bricks == nullptr
          ? !options.parts.empty() || options.part_runs != nullptr
          : !options.parts.empty() && options.parts.size() != options.bricks->min.size()) {
    refuse(fmt::format("{} words for the parts of other bricks", options.parts.size()));
  }
}

}  // namespace footwall::isosurface::detail
