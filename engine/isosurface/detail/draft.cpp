#include "engine/isosurface/detail/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "engine/isosurface/detail/arguments.h"
#include "storage/base/error.h"

namespace footwall::isosurface::detail {
namespace {

template <class Value>
void copy(const std::vector<Value>& from, PageVector<Value>& into) {
  into.resize_uninitialised(from.size());
  std::copy(from.begin(), from.end(), into.data());
}

}  // namespace

Draft::Draft(const Field& from, float value, const ExtractOptions& options, std::string_view variant)
    : field(from), isovalue(value), normals(options.normals), hands_over_keys_(options.keys) {
  check_arguments(field, isovalue, options);
  if (options.bricks != nullptr) {
    throw Error(ErrorCode::kUnsupported, fmt::format("the variant {} reads every sample", variant),
                "leave the pyramid out, or take the variant bricks");
  }
  cells = options.cells.value_or(cells_of(field));
  marched_ = cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[axis] -= field.origin[axis];
    cells.hi[axis] -= field.origin[axis];
  }
  samples = cells;
  for (int axis = 0; axis < 3; ++axis) samples.hi[axis] += 1;
}

std::uint32_t Draft::next_number() const {
  if (positions.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::kUnsupported, "the surface has 2^32 vertices or more", "extract it in parts");
  }
  return static_cast<std::uint32_t>(positions.size());
}

VertexKey Draft::key(std::int64_t i, std::int64_t j, std::int64_t k, int axis) const {
  const std::int64_t row = (i + field.origin[0]) * field.volume_size[1] + j + field.origin[1];
  return 4 * static_cast<VertexKey>(row * field.volume_size[2] + k + field.origin[2]) +
         static_cast<VertexKey>(axis);
}

std::uint32_t Draft::add_vertex(int axis, std::int64_t i, std::int64_t j, std::int64_t k, float t,
                                const Point& normal) {
  const std::uint32_t number = next_number();
  Point p{static_cast<float>(i + field.origin[0]), static_cast<float>(j + field.origin[1]),
          static_cast<float>(k + field.origin[2])};
  (axis == 0 ? p.i : axis == 1 ? p.j : p.k) += t;
  positions.push_back(p);
  if (normals) normal_vectors.push_back(normal);
  keys.push_back(key(i, j, k, axis));
  return number;
}

std::uint32_t Draft::reserve_centre(std::int64_t i, std::int64_t j, std::int64_t k) {
  const std::uint32_t number = next_number();
  positions.emplace_back();
  if (normals) normal_vectors.emplace_back();
  keys.push_back(key(i, j, k, 3));
  return number;
}

void Draft::place_centre(std::uint32_t number, std::span<const std::uint32_t> loop) {
  positions[number] = centre_position(loop, positions.data());
  if (normals) normal_vectors[number] = centre_normal(loop, normal_vectors.data());
}

void Draft::sort_vertices() {
  // By rows first, without comparing, then the few of each row: k, j and i edges, centres.
  const auto size = static_cast<VertexKey>(field.volume_size[2]);
  const auto row_of = [&](std::uint32_t n) { return (keys[n] >> 2) / size; };
  const auto rank_of = [&](std::uint32_t n) {
    const VertexKey axis = keys[n] & 3;
    return (axis == 3 ? 3 : 2 - axis) * size + (keys[n] >> 2) % size;
  };
  const auto rows = static_cast<std::size_t>(field.size[0] * field.volume_size[1]);
  const VertexKey first_row = static_cast<VertexKey>(field.origin[0] * field.volume_size[1]);
  std::vector<std::uint32_t> first(rows + 1, 0), order(keys.size());
  for (std::uint32_t n = 0; n < keys.size(); ++n) ++first[row_of(n) - first_row + 1];
  for (std::size_t row = 1; row <= rows; ++row) first[row] += first[row - 1];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t n = 0; n < keys.size(); ++n) order[next[row_of(n) - first_row]++] = n;
  for (std::size_t row = 0; row < rows; ++row) {
    std::sort(order.begin() + first[row], order.begin() + first[row + 1],
              [&](std::uint32_t a, std::uint32_t b) { return rank_of(a) < rank_of(b); });
  }
  std::vector<std::uint32_t> number(order.size());
  for (std::uint32_t n = 0; n < order.size(); ++n) number[order[n]] = n;
  const auto permute = [&](auto& all) {
    std::remove_reference_t<decltype(all)> sorted(all.size());
    for (std::size_t n = 0; n < all.size(); ++n) sorted[n] = all[order[n]];
    all = std::move(sorted);
  };
  permute(positions);
  permute(keys);
  if (normals) permute(normal_vectors);
  for (Triangle& t : triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
}

void Draft::hand_over(Surface& into) {
  copy(positions, into.positions);
  copy(triangles, into.triangles);
  copy(normal_vectors, into.normals);
  if (hands_over_keys_) {
    copy(keys, into.keys);
  } else {
    into.keys.resize_uninitialised(0);
  }
  into.cells = marched_;
  // One entry a row, also where there was nothing to march.
  row_first.resize(static_cast<std::size_t>(cells.size(0) * cells.size(1)) + 1, triangles.size());
  into.row_first = std::move(row_first);
}

}  // namespace footwall::isosurface::detail
