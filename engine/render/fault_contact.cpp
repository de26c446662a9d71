#include "engine/render/fault_contact.h"

#include <algorithm>
#include <cmath>

namespace footwall::render {
namespace {

constexpr std::size_t kMostInALeaf = 8;

using Corners = std::array<Vec3, 3>;

struct Extent {
  Vec3 lo{INFINITY, INFINITY, INFINITY};
  Vec3 hi{-INFINITY, -INFINITY, -INFINITY};
  void add(const Vec3& p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  bool meets(const Extent& o) const {
    return lo.x <= o.hi.x && o.lo.x <= hi.x && lo.y <= o.hi.y && o.lo.y <= hi.y && lo.z <= o.hi.z &&
           o.lo.z <= hi.z;
  }
};

Extent extent_of(const Corners& corners) {
  Extent all;
  for (const Vec3& p : corners) all.add(p);
  return all;
}

Corners corners_of(const Triangles& surface, std::size_t t) {
  Corners corners;
  for (std::size_t n = 0; n < 3; ++n)
    corners[n] = surface.vertices[static_cast<std::size_t>(surface.triangles[t][n])];
  return corners;
}

bool finite(const Corners& c) {
  const Vec3 sum = c[0] + c[1] + c[2];
  return std::isfinite(sum.x + sum.y + sum.z);
}

// A tree of boxes around a surface's triangles, halved by their order along the longest side.
class Tree {
 public:
  explicit Tree(const Triangles& surface) : surface_(surface) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (finite(corners_of(surface, t))) order_.push_back(t);
    }
    if (!order_.empty()) build(0, order_.size());
  }
  template <class Found>
  void find(const Extent& box, const Found& found) const {
    if (!nodes_.empty()) find(0, box, found);
  }

 private:
  struct Node {
    Extent extent;
    std::size_t first, last;  // of order_
    std::size_t right = 0;    // the second half's node, the first's is the next; 0 = a leaf
  };

  std::size_t build(std::size_t first, std::size_t last) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({{}, first, last, 0});
    Extent extent;
    for (std::size_t n = first; n < last; ++n) {
      for (const Vec3& p : corners_of(surface_, order_[n])) extent.add(p);
    }
    nodes_[at].extent = extent;
    if (last - first <= kMostInALeaf) return at;
    const Vec3 size = extent.hi - extent.lo;
    const auto along = [&](std::size_t t) {
      const Corners c = corners_of(surface_, t);
      const Vec3 sum = c[0] + c[1] + c[2];
      return size.x >= size.y && size.x >= size.z ? sum.x : size.y >= size.z ? sum.y : sum.z;
    };
    const std::size_t middle = (first + last) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last), [&](std::size_t a, std::size_t b) {
                       const double sa = along(a);
                       const double sb = along(b);
                       return sa != sb ? sa < sb : a < b;
                     });
    build(first, middle);
    const std::size_t right = build(middle, last);
    nodes_[at].right = right;
    return at;
  }

  template <class Found>
  void find(std::size_t at, const Extent& box, const Found& found) const {
    const Node& node = nodes_[at];
    if (!node.extent.meets(box)) return;
    if (node.right == 0) {
      for (std::size_t n = node.first; n < node.last; ++n) found(order_[n]);
      return;
    }
    find(at + 1, box, found);
    find(node.right, box, found);
  }

  Triangles surface_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

// Where the triangle meets the plane n . p = d: two points, or none.
bool meet(const Corners& triangle, const Vec3& n, double d, std::array<Vec3, 2>& ends) {
  std::size_t count = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec3& p = triangle[e];
    const Vec3& q = triangle[(e + 1) % 3];
    const double dp = dot(n, p) - d;
    const double dq = dot(n, q) - d;
    // A corner in the plane counts as in front of it: no edge is met twice.
    if ((dp >= 0) != (dq >= 0)) ends[count++] = p + (q - p) * (dp / (dp - dq));
  }
  return count == 2;
}

// Both triangles meet the line that their planes share in a segment each; the contact is what is in both.
void add_contact(const Corners& a, const Corners& b, std::vector<Vec3>& to) {
  const Vec3 na = cross(a[1] - a[0], a[2] - a[0]);
  const Vec3 nb = cross(b[1] - b[0], b[2] - b[0]);
  const Vec3 along = cross(na, nb);
  const double far = length(along);
  if (!(far > 1e-9 * length(na) * length(nb))) return;
  std::array<Vec3, 2> in_a;
  std::array<Vec3, 2> in_b;
  if (!meet(a, nb, dot(nb, b[0]), in_a) || !meet(b, na, dot(na, a[0]), in_b)) return;
  const auto place = [&](const Vec3& p) { return dot(p, along); };
  if (place(in_a[0]) > place(in_a[1])) std::swap(in_a[0], in_a[1]);
  if (place(in_b[0]) > place(in_b[1])) std::swap(in_b[0], in_b[1]);
  const Vec3& from = place(in_a[0]) > place(in_b[0]) ? in_a[0] : in_b[0];
  const Vec3& end = place(in_a[1]) < place(in_b[1]) ? in_a[1] : in_b[1];
  if (!(place(from) < place(end))) return;
  to.push_back(from);
  to.push_back(end);
}

}  // namespace

std::vector<Vec3> contacts_of(std::span<const Triangles> surfaces) {
  std::vector<Vec3> contacts;
  std::size_t triangles = 0;
  for (const Triangles& surface : surfaces) triangles += surface.triangles.size();
  if (triangles > kMostTrianglesForContacts) return contacts;
  std::vector<Tree> trees(surfaces.begin(), surfaces.end());
  for (std::size_t b = 1; b < surfaces.size(); ++b) {
    for (std::size_t t = 0; t < surfaces[b].triangles.size(); ++t) {
      const Corners corners = corners_of(surfaces[b], t);
      if (!finite(corners)) continue;
      const Extent box = extent_of(corners);
      for (std::size_t a = 0; a < b; ++a) {
        trees[a].find(box, [&](std::size_t other) {
          const Corners found = corners_of(surfaces[a], other);
          if (extent_of(found).meets(box)) add_contact(found, corners, contacts);
        });
      }
    }
  }
  return contacts;
}

}  // namespace footwall::render
