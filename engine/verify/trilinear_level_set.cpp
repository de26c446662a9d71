#include "engine/verify/trilinear_level_set.h"

#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace footwall::verify {
namespace {

constexpr int kDeepest = 14;  // halvings of each axis
using Corners = std::array<double, 8>;
using Place = std::array<int, 3>;  // in units of 2^-kDeepest of the cell

// The four values of a side of a box, x or y fastest.
std::array<double, 4> side_of(const Corners& v, int axis, int side) {
  const int u = axis == 0 ? 2 : 1;
  const int w = axis == 2 ? 2 : 4;
  const int base = side << axis;
  return {v[base], v[base | u], v[base | w], v[base | u | w]};
}

// The two halves of a box along an axis; linear along it.
std::pair<Corners, Corners> halves(const Corners& v, int axis) {
  std::pair<Corners, Corners> both{v, v};
  for (int c = 0; c < 8; ++c) {
    if ((c >> axis & 1) != 0) continue;
    const int high = c | 1 << axis;
    const double middle = (v[c] + v[high]) / 2;
    both.first[high] = middle;
    both.second[c] = middle;
  }
  return both;
}

int count_inside(const Corners& v) {
  int inside = 0;
  for (const double value : v) inside += value >= 0 ? 1 : 0;
  return inside;
}

// The side to which the field grows along the axis everywhere in the box, 0 or 1; -1 if there is none. The
// derivative is bilinear across the axis, so its corners tell.
int growing_side(const Corners& v, int axis) {
  bool up = true;
  bool down = true;
  for (int c = 0; c < 8; ++c) {
    if ((c >> axis & 1) != 0) continue;
    const double change = v[c | 1 << axis] - v[c];
    up = up && change >= 0;
    down = down && change <= 0;
  }
  if (up) return 1;
  return down ? 0 : -1;
}

// Parts of the inside of a rectangle with a bilinear field; none of them has a hole.
int planar_parts(const std::array<double, 4>& v) {
  int inside = 0;
  for (const double value : v) inside += value >= 0 ? 1 : 0;
  if (inside == 0) return 0;
  const bool ambiguous = inside == 2 && (v[0] >= 0) == (v[3] >= 0);
  return ambiguous && !face_joins_inside(v[0], v[1], v[2], v[3]) ? 2 : 1;
}

// The Euler number of the inside of a box. Where the field grows along an axis, the inside shrinks along it
// to that side of the box without changing its form.
bool add_euler(const Corners& v, int depth, int& euler) {
  const int inside = count_inside(v);
  if (inside == 0) return true;
  if (inside == 8) {
    euler += 1;
    return true;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int side = growing_side(v, axis);
    if (side < 0) continue;
    euler += planar_parts(side_of(v, axis, side));
    return true;
  }
  if (depth == 3 * kDeepest) return false;
  const int axis = depth % 3;
  const auto [low, high] = halves(v, axis);
  euler -= planar_parts(side_of(high, axis, 0));
  return add_euler(low, depth + 1, euler) && add_euler(high, depth + 1, euler);
}

// The Euler number of the inside on the surface of a cell, which is closed.
int euler_on_faces(const Corners& v) {
  int euler = count_inside(v);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) euler += planar_parts(side_of(v, axis, side));
    for (int c = 0; c < 8; ++c) {
      if ((c >> axis & 1) == 0) euler -= v[c] >= 0 || v[c | 1 << axis] >= 0 ? 1 : 0;
    }
  }
  return euler;
}

struct Box {
  Place low;
  Place size;
  Corners v;
};

// The parts of a cell halved until each of its boxes is simple, and how the inside hangs together.
class Parts {
 public:
  // `sign` -1: of the outside instead.
  static std::optional<int> count(const Corners& values, int sign) {
    Parts parts(sign);
    const Place size{1 << kDeepest, 1 << kDeepest, 1 << kDeepest};
    if (!parts.halve({{0, 0, 0}, size, values}, 0)) return std::nullopt;
    for (const Box& box : parts.boxes_) parts.join_in(box);
    int roots = 0;
    for (std::size_t n = 0; n < parts.parent_.size(); ++n) roots += parts.parent_[n] == n ? 1 : 0;
    return roots;
  }

 private:
  explicit Parts(int sign) : sign_(sign) {}

  bool is_in(double value) const { return (value >= 0) == (sign_ > 0); }

  bool halve(const Box& box, int depth) {
    const int inside = count_inside(box.v);
    bool simple = inside == 0 || inside == 8;
    for (int axis = 0; axis < 3; ++axis) simple = simple || growing_side(box.v, axis) >= 0;
    if (simple) {
      boxes_.push_back(box);
      for (int c = 0; c < 8; ++c) {
        if (is_in(box.v[c])) number(corner(box, c));
      }
      return true;
    }
    if (depth == 3 * kDeepest) return false;
    const int axis = depth % 3;
    const auto [low, high] = halves(box.v, axis);
    Box half = box;
    half.size[axis] /= 2;
    half.v = low;
    if (!halve(half, depth + 1)) return false;
    half.low[axis] += half.size[axis];
    half.v = high;
    return halve(half, depth + 1);
  }

  static Place corner(const Box& box, int c) {
    Place at = box.low;
    for (int axis = 0; axis < 3; ++axis) at[axis] += (c >> axis & 1) * box.size[axis];
    return at;
  }

  std::size_t number(const Place& at) {
    const auto [place, is_new] = numbers_.try_emplace(at, parent_.size());
    if (is_new) parent_.push_back(parent_.size());
    return place->second;
  }

  std::size_t root(std::size_t n) const {
    while (parent_[n] != n) n = parent_[n];
    return n;
  }
  void unite(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

  // Every known point of the inside in the box hangs together with a corner on the side to which the inside
  // grows, and those corners as the bilinear field there says.
  void join_in(const Box& box) {
    const int inside = count_inside(box.v);
    if (inside == (sign_ > 0 ? 0 : 8)) return;
    int axis = 0;
    int side = 1;  // any, if all of the box is inside
    if (inside != 0 && inside != 8) {
      while (growing_side(box.v, axis) < 0) ++axis;
      side = growing_side(box.v, axis);
      if (sign_ < 0) side = 1 - side;
    }
    for (const auto& [at, n] : numbers_) {
      bool in_box = true;
      for (int each = 0; each < 3; ++each)
        in_box = in_box && at[each] >= box.low[each] && at[each] <= box.low[each] + box.size[each];
      if (in_box) unite(n, numbers_.at(corner(box, climb(box, at, axis, side))));
    }
    join_on_side(box, axis, side);
  }

  void join_on_side(const Box& box, int axis, int side) {
    const std::array<double, 4> v = side_of(box.v, axis, side);
    std::vector<std::size_t> corners;
    for (int c = 0; c < 8; ++c) {
      if ((c >> axis & 1) == side && is_in(box.v[c])) corners.push_back(numbers_.at(corner(box, c)));
    }
    const bool across = corners.size() == 2 && is_in(v[0]) == is_in(v[3]);
    if (across && face_joins_inside(v[0], v[1], v[2], v[3]) != (sign_ > 0)) return;
    for (const std::size_t each : corners) unite(each, corners.front());
  }

  // The corner that is reached from a point of the box by going to `side` along `first`, then along the other
  // axes away from the level.
  int climb(const Box& box, const Place& at, int first, int side) const {
    std::array<double, 3> t{};
    for (int axis = 0; axis < 3; ++axis)
      t[axis] = static_cast<double>(at[axis] - box.low[axis]) / static_cast<double>(box.size[axis]);
    const auto value = [&] {
      double sum = 0;
      for (int c = 0; c < 8; ++c)
        sum += box.v[c] * ((c & 1) != 0 ? t[0] : 1 - t[0]) * ((c & 2) != 0 ? t[1] : 1 - t[1]) *
               ((c & 4) != 0 ? t[2] : 1 - t[2]);
      return sum * sign_;
    };
    t[first] = side;
    int reached = side << first;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == first) continue;
      t[axis] = 0;
      const double low = value();
      t[axis] = 1;
      if (value() >= low) {
        reached |= 1 << axis;
      } else {
        t[axis] = 0;
      }
    }
    return reached;
  }

  int sign_;
  std::vector<Box> boxes_;
  std::map<Place, std::size_t> numbers_;
  std::vector<std::size_t> parent_;
};

}  // namespace

bool face_joins_inside(double a, double b, double c, double d) {
  const double saddle = a * d - b * c;
  return a >= 0 ? saddle >= 0 : saddle <= 0;
}

std::optional<int> trilinear_euler_number(const Corners& values) {
  int euler = 0;
  if (!add_euler(values, 0, euler)) return std::nullopt;
  // The surface and the inside of the faces together close off the inside of the cell.
  return 2 * euler - euler_on_faces(values);
}

std::optional<LevelSet> trilinear_level_set(const Corners& values) {
  const std::optional<int> euler = trilinear_euler_number(values);
  const std::optional<int> inside = Parts::count(values, 1);
  const std::optional<int> outside = Parts::count(values, -1);
  if (!euler || !inside || !outside) return std::nullopt;
  return LevelSet{*euler, *inside, *outside};
}

std::optional<int> grid_euler_number(std::span<const double> values, int n) {
  const auto at = [&](int x, int y, int z) { return values[static_cast<std::size_t>(x + n * (y + n * z))]; };
  int volume = 0;
  int border = 0;
  // Every vertex, edge, face and cell of the grid, by its lower end and its extent; those that lie on the
  // border of the grid are parts of its closed surface, all others of the volume.
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        for (int extent = 0; extent < 8; ++extent) {
          const Place low{x, y, z};
          Place high = low;
          bool on_border = false;
          bool in_grid = true;
          for (int axis = 0; axis < 3; ++axis) {
            high[axis] += extent >> axis & 1;
            in_grid = in_grid && high[axis] < n;
            on_border = on_border || (high[axis] == low[axis] && (low[axis] == 0 || low[axis] == n - 1));
          }
          if (!in_grid) continue;
          Corners v{};
          for (int c = 0; c < 8; ++c)
            v[c] = at((c & 1) != 0 ? high[0] : x, (c & 2) != 0 ? high[1] : y, (c & 4) != 0 ? high[2] : z);
          int euler = 0;
          if (!add_euler(v, 0, euler)) return std::nullopt;
          const int dimension = (extent & 1) + (extent >> 1 & 1) + (extent >> 2 & 1);
          if (on_border) border += dimension == 1 ? -euler : euler;
          if (!on_border) volume += dimension % 2 == 1 ? euler : -euler;
        }
      }
    }
  }
  return 2 * volume - border;
}

}  // namespace footwall::verify
