#include "engine/isosurface/cap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/isosurface/canonical.h"
#include "engine/isosurface/case_tables.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

using survey::Index;

constexpr int kMostCorners = 6;

class Cap {
 public:
  Cap(const Field& field, float isovalue, const Surface& surface)
      : field_(field), isovalue_(isovalue), surface_(surface), first_new_(surface.positions.size()) {
    for (std::uint32_t n = 0; n < surface.keys.size(); ++n) {
      const VertexKey key = surface.keys[n];
      const KeyPlace place = place_of(key, field.volume_size);
      for (int axis = 0; axis < 3; ++axis) {
        const bool border = place.sample[axis] == 0 || place.sample[axis] == field.volume_size[axis] - 1;
        if (axis != place.axis && place.axis != 3 && border) numbers_[key] = n;
      }
    }
  }

  void run() {
    const survey::Box& cells = surface_.cells;
    for (int axis = 0; axis < 3; ++axis) {
      if (cells.lo[axis] == 0) add_side(axis, 0);
      if (cells.hi[axis] == field_.volume_size[axis] - 1) add_side(axis, 1);
    }
  }

  void append_to(Surface& surface) const {
    append(positions_, surface.positions);
    append(keys_, surface.keys);
    if (!surface.normals.empty() || first_new_ == 0) append(normals_, surface.normals);
    append(triangles_, surface.triangles);
  }

 private:
  template <class Value>
  static void append(const std::vector<Value>& more, PageVector<Value>& all) {
    PageVector<Value> both;
    both.resize_uninitialised(all.size() + more.size());
    std::copy(all.all().begin(), all.all().end(), both.data());
    std::copy(more.begin(), more.end(), both.data() + all.size());
    all = std::move(both);
  }

  void add_side(int axis, int side) {
    survey::Box cells = surface_.cells;
    if (cells.empty()) return;
    cells.lo[axis] = side == 0 ? 0 : field_.volume_size[axis] - 2;
    cells.hi[axis] = cells.lo[axis] + 1;
    Index cell;
    for (cell[0] = cells.lo[0]; cell[0] < cells.hi[0]; ++cell[0]) {
      for (cell[1] = cells.lo[1]; cell[1] < cells.hi[1]; ++cell[1]) {
        for (cell[2] = cells.lo[2]; cell[2] < cells.hi[2]; ++cell[2]) add_square(cell, axis, side);
      }
    }
  }

  float value_at(const Index& sample) const {
    std::int64_t at = 0;
    for (int axis = 0; axis < 3; ++axis) at = at * field_.size[axis] + sample[axis] - field_.origin[axis];
    return field_.values[static_cast<std::size_t>(at)];
  }

  // The face of a cell on the border.
  void add_square(const Index& cell, int axis, int side) {
    std::array<float, 8> values;
    unsigned signs = 0;
    for (int corner = 0; corner < 8; ++corner) {
      values[corner] =
          value_at({cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)});
      if (std::isnan(values[corner])) return;
      signs |= (values[corner] >= isovalue_ ? 1U : 0U) << corner;
    }
    const int u = axis == 0 ? 1 : 0, w = axis == 2 ? 1 : 2;
    // The corners around the square; seen from outside of the box they run against the clock where u, w and
    // the outward direction are a left-handed system.
    std::array<Index, 4> around;
    std::array<bool, 4> inside;
    for (int n = 0; n < 4; ++n) {
      const int du = n == 1 || n == 2 ? 1 : 0, dw = n >> 1;
      around[n] = cell;
      around[n][axis] += side;
      around[n][u] += du;
      around[n][w] += dw;
      inside[n] = (signs >> (side << axis | du << u | dw << w) & 1) != 0;
    }
    const bool right_handed = (axis != 1) == (side == 1);
    const bool ambiguous = inside[0] == inside[2] && inside[1] == inside[3] && inside[0] != inside[1];
    const bool apart = ambiguous && (decide(signs, values, isovalue_) >> (2 * axis + side) & 1) == 0;
    if (apart) {
      for (int n = 0; n < 4; ++n) {
        if (!inside[n]) continue;
        add_polygon({crossing(around[(n + 3) % 4], around[n]), corner(around[n]),
                     crossing(around[n], around[(n + 1) % 4])},
                    3, right_handed);
      }
      return;
    }
    std::array<std::uint32_t, kMostCorners> polygon;
    int count = 0;
    for (int n = 0; n < 4; ++n) {
      if (inside[n]) polygon[count++] = corner(around[n]);
      if (inside[n] != inside[(n + 1) % 4]) polygon[count++] = crossing(around[n], around[(n + 1) % 4]);
    }
    add_polygon(polygon, count, right_handed);
  }

  void add_polygon(const std::array<std::uint32_t, kMostCorners>& polygon, int count, bool right_handed) {
    for (int n = 2; n < count; ++n) {
      const std::uint32_t b = polygon[n - 1], c = polygon[n];
      triangles_.push_back(right_handed ? Triangle{polygon[0], b, c} : Triangle{polygon[0], c, b});
    }
  }

  // The surface's vertex between two neighbouring samples.
  std::uint32_t crossing(const Index& a, const Index& b) const {
    int axis = 0;
    while (a[axis] == b[axis]) ++axis;
    const auto found = numbers_.find(key_of(a[axis] < b[axis] ? a : b, axis, field_.volume_size));
    if (found == numbers_.end()) {
      throw Error(ErrorCode::kInvalid, "the surface to be capped is not that of the field and the isovalue");
    }
    return found->second;
  }

  std::uint32_t corner(const Index& sample) {
    const VertexKey key = kSampleKey | key_of(sample, 0, field_.volume_size) / 4;
    const std::size_t next = first_new_ + positions_.size();
    const auto [found, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(next));
    if (!is_new) return found->second;
    if (next >= std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::kUnsupported, "the capped surface has 2^32 vertices or more",
                  "extract it in parts");
    }
    positions_.push_back(
        {static_cast<float>(sample[0]), static_cast<float>(sample[1]), static_cast<float>(sample[2])});
    keys_.push_back(key);
    std::array<float, 3> out{0, 0, 0};
    float faces = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (sample[axis] == 0) out[axis] = -1;
      if (sample[axis] == field_.volume_size[axis] - 1) out[axis] = 1;
      faces += out[axis] != 0 ? 1.0F : 0.0F;
    }
    const float length = std::sqrt(faces);
    normals_.push_back({out[0] / length, out[1] / length, out[2] / length});
    return found->second;
  }

  const Field& field_;
  const float isovalue_;
  const Surface& surface_;
  const std::size_t first_new_;
  std::unordered_map<VertexKey, std::uint32_t> numbers_;  // of the vertices on the border
  std::vector<Point> positions_, normals_;
  std::vector<VertexKey> keys_;
  std::vector<Triangle> triangles_;
};

}  // namespace

void cap(const Field& field, float isovalue, Surface& surface) {
  if (surface.keys.size() != surface.positions.size()) {
    throw Error(ErrorCode::kInvalid, "a surface without keys cannot be capped", "extract it with keys");
  }
  const survey::Box cells = cells_of(field);
  if (survey::intersection(cells, surface.cells) != surface.cells) {
    throw Error(ErrorCode::kInvalid, "the surface to be capped reaches beyond its field");
  }
  Cap sides(field, isovalue, surface);
  sides.run();
  sides.append_to(surface);
}

}  // namespace footwall::isosurface
