// Planes of constant inline, one after the other, two of which are remembered: what the variants `plane` and
// `vector` have in common. They differ in how the samples of a plane are looked at, which a class Planes
// does:
//
//   Planes(const Draft&, const PlaneShape&)
//   void look_at(i)                   reads the samples of plane i; called for each plane once, ascending
//   bool classify(i, signs, nulls)    of each cell between planes i and i + 1, by its first corner: the signs
//                                     of its corners, and whether one of them is null; returns whether any is
//   void intersect(i, crossing)       crossing[axis]: for each edge of plane i along `axis`, not zero where
//   its
//                                     ends' signs differ (axis 0: edges to plane i + 1, if there is one)
//   float t(axis, i, j, k)            where such an edge is crossed
//   Point gradient(i, j, k)           of a sample of plane i or i + 1, twice
//
// A class Table (half_table.h) says what triangles a cell has.
// Indices i, j, k count from the field's first sample.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/detail/draft.h"

namespace footwall::isosurface::detail {

// Arrays of a plane: rows of samples with one dummy after each, a dummy row before and after, so that every
// neighbour exists.
struct PlaneShape {
  explicit PlaneShape(const Draft& draft)
      : first_j(draft.samples.lo[1]),
        first_k(draft.samples.lo[2]),
        rows(draft.samples.size(1)),
        columns(draft.samples.size(2)),
        stride(columns + 1) {}
  std::int64_t first_j, first_k, rows, columns, stride;
  static constexpr std::int64_t kPadding = 64;  // whole vectors may be read and written behind the end
  std::size_t room() const { return static_cast<std::size_t>((rows + 2) * stride + kPadding); }
  std::size_t at(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((j - first_j + 1) * stride + k - first_k + 1);
  }
};

template <class Planes, class Table>
class Sweep {
 public:
  Sweep(Draft& draft, const Table& table)
      : draft_(draft), table_(table), shape_(draft), planes_(draft, shape_) {
    for (auto& axis : crossing_) axis.resize(shape_.room());
    for (auto& plane : numbers_) {
      for (auto& axis : plane) axis.resize(shape_.room());
    }
    for (Cells& plane : cells_) {
      plane.signs.resize(shape_.room());
      plane.nulls.resize(shape_.room());
      plane.alternatives.resize(shape_.room());
      plane.centres.resize(shape_.room());
    }
  }

  void run() {
    if (draft_.cells.empty()) return;
    const std::int64_t first = draft_.samples.lo[0], last = draft_.samples.hi[0] - 1;
    planes_.look_at(first);
    for (std::int64_t i = first; i <= last; ++i) {
      if (i < last) {
        planes_.look_at(i + 1);
        Cells& cells = cells_of_plane(i);
        cells.has_nulls = planes_.classify(i, cells.signs.data(), cells.nulls.data());
      }
      planes_.intersect(i, {crossing_[0].data(), crossing_[1].data(), crossing_[2].data()});
      number(i, i > first, i < last);
      if (i > first) march(i - 1);
    }
  }

 private:
  struct Cells {
    std::vector<std::uint8_t> signs, nulls;
    std::vector<Alternative> alternatives;  // of undecided cells
    std::vector<std::uint32_t> centres;     // numbers of the centre vertices
    bool has_nulls = false;
  };
  Cells& cells_of_plane(std::int64_t i) { return cells_[i & 1]; }

  // Calls visit(k) where marks[at(j, k)] is not zero, eight samples at a glance.
  template <class Visit>
  void for_each_mark(const std::vector<std::uint8_t>& marks, std::int64_t j, std::int64_t count,
                     Visit&& visit) {
    const std::uint8_t* const row = marks.data() + shape_.at(j, shape_.first_k);
    for (std::int64_t n = 0; n < count; n += 8) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, row + n, sizeof eight);
      while (eight != 0) {
        const int byte = std::countr_zero(eight) / 8;
        if (n + byte >= count) break;
        visit(shape_.first_k + n + byte);
        eight &= ~(std::uint64_t{0xff} << (8 * byte));
      }
    }
  }

  // Whether one of the four cells around an edge has no null sample.
  bool is_used(std::int64_t i, std::int64_t j, std::int64_t k, int axis, bool below, bool above) const {
    for (int n = 0; n < 4; ++n) {
      const survey::Index cell{i - (axis == 0 ? 0 : n & 1),
                               j - (axis == 0   ? n & 1
                                    : axis == 1 ? 0
                                                : n >> 1),
                               k - (axis == 2 ? 0 : n >> 1)};
      if (cell[0] < i ? !below : !above) continue;
      if (cell[1] < draft_.cells.lo[1] || cell[1] >= draft_.cells.hi[1] || cell[2] < draft_.cells.lo[2] ||
          cell[2] >= draft_.cells.hi[2]) {
        continue;
      }
      if (cells_[cell[0] & 1].nulls[shape_.at(cell[1], cell[2])] == 0) return true;
    }
    return false;
  }

  // Gives the intersections of plane i, of the edges to the next one and of the cells between them their
  // numbers, row by row. below, above: whether there are cells on that side of the plane.
  void number(std::int64_t i, bool below, bool above) {
    const bool check = (below && cells_[(i - 1) & 1].has_nulls) || (above && cells_[i & 1].has_nulls);
    auto& numbers = numbers_[i & 1];
    for (std::int64_t j = draft_.samples.lo[1]; j < draft_.samples.hi[1]; ++j) {
      for (const int axis : {2, 1, 0}) {
        if ((axis == 0 && !above) || (axis == 1 && j + 1 == draft_.samples.hi[1])) continue;
        for_each_mark(crossing_[axis], j, shape_.columns - (axis == 2 ? 1 : 0), [&](std::int64_t k) {
          if (check && !is_used(i, j, k, axis, below, above)) return;
          numbers[axis][shape_.at(j, k)] = add_vertex(axis, i, j, k);
        });
      }
      if (above && j < draft_.cells.hi[1]) decide_row(i, j);
    }
  }

  std::uint32_t add_vertex(int axis, std::int64_t i, std::int64_t j, std::int64_t k) {
    const float t = planes_.t(axis, i, j, k);
    Point normal_vector;
    if (draft_.normals) {
      const Point upper = axis == 0   ? planes_.gradient(i + 1, j, k)
                          : axis == 1 ? planes_.gradient(i, j + 1, k)
                                      : planes_.gradient(i, j, k + 1);
      const bool falls = *draft_.at(i, j, k) >= draft_.isovalue;
      normal_vector = normal(planes_.gradient(i, j, k), upper, t, axis, falls);
    }
    return draft_.add_vertex(axis, i, j, k, t, normal_vector);
  }

  // Calls visit(k, place) for the cells of a row that the surface passes, eight cells at a glance.
  template <class Visit>
  void for_each_active(const Cells& cells, std::int64_t j, Visit&& visit) {
    const std::size_t row = shape_.at(j, shape_.first_k);
    const std::int64_t count = shape_.columns - 1;
    for (std::int64_t n = 0; n < count; n += 8) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, cells.signs.data() + row + n, sizeof eight);
      if (eight == 0 || eight == ~std::uint64_t{0}) continue;
      for (std::int64_t c = n; c < std::min(n + 8, count); ++c) {
        const std::size_t p = row + static_cast<std::size_t>(c);
        if (cells.signs[p] != 0 && cells.signs[p] != 255 && cells.nulls[p] == 0) visit(shape_.first_k + c, p);
      }
    }
  }

  // Decides the cells of a row that their signs leave open, and numbers the centre vertices, which get their
  // place once the vertices around them have theirs.
  void decide_row(std::int64_t i, std::int64_t j) {
    Cells& cells = cells_of_plane(i);
    for_each_active(cells, j, [&](std::int64_t k, std::size_t p) {
      const unsigned signs = cells.signs[p];
      cells.alternatives[p] = 0;
      if (table_.undecided(signs)) {
        std::array<float, 8> values;
        for (int corner = 0; corner < 8; ++corner) {
          values[corner] = *draft_.at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
        }
        cells.alternatives[p] = table_.decide(signs, values, draft_.isovalue);
      }
      if (table_.entry(signs, cells.alternatives[p]).has_centre) {
        cells.centres[p] = draft_.reserve_centre(i, j, k);
      }
    });
  }

  // Connects the intersections of the cells between planes i and i + 1.
  void march(std::int64_t i) {
    const Cells& cells = cells_of_plane(i);
    for (std::int64_t j = draft_.cells.lo[1]; j < draft_.cells.hi[1]; ++j) {
      draft_.begin_row();
      for_each_active(cells, j, [&](std::int64_t, std::size_t p) {
        const auto entry = table_.entry(cells.signs[p], cells.alternatives[p]);
        std::array<std::uint32_t, kCentre + 1> vertex;
        for (int edge = 0; edge < kCentre; ++edge) vertex[edge] = number_on(edge, i, p);
        vertex[kCentre] = cells.centres[p];
        if (entry.has_centre) {
          std::array<std::uint32_t, kCentre> loop;
          std::size_t count = 0;
          for (int edge = 0; edge < kCentre; ++edge) {
            if ((entry.centre_edges >> edge & 1) != 0) loop[count++] = vertex[edge];
          }
          draft_.place_centre(vertex[kCentre], std::span(loop).first(count));
        }
        entry.for_each_triangle([&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
          draft_.triangles.push_back({vertex[a], vertex[b], vertex[c]});
        });
      });
    }
  }

  // Of an edge that is not crossed, whatever was there.
  std::uint32_t number_on(int edge, std::int64_t i, std::size_t p) const {
    const int axis = edge / 4, low = edge & 1, high = edge >> 1 & 1;
    switch (axis) {
      case 0:
        return numbers_[i & 1][0][p + static_cast<std::size_t>(low * shape_.stride + high)];
      case 1:
        return numbers_[(i + low) & 1][1][p + static_cast<std::size_t>(high)];
      default:
        return numbers_[(i + low) & 1][2][p + static_cast<std::size_t>(high * shape_.stride)];
    }
  }

  Draft& draft_;
  const Table& table_;
  PlaneShape shape_;
  Planes planes_;
  std::array<std::vector<std::uint8_t>, 3> crossing_;
  std::array<std::array<std::vector<std::uint32_t>, 3>, 2> numbers_;  // [plane & 1][axis]
  std::array<Cells, 2> cells_;                                        // [plane & 1]
};

}  // namespace footwall::isosurface::detail
