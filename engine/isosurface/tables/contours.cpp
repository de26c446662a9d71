#include "engine/isosurface/tables/contours.h"

#include <numeric>

#include "engine/isosurface/tables/cell.h"

namespace footwall::isosurface::tables {
namespace {

// The vertex after each cut edge's on its loop: on every face a contour runs from an edge where the ring of
// corners goes inside to one where it goes outside. It is the end of the same inside run, or, where the
// inside corners of an ambiguous face are joined, the start of the outside run before it.
std::array<int, 12> steps(unsigned signs, unsigned joined) {
  std::array<int, 12> next{};
  next.fill(-1);
  const unsigned ambiguous = ambiguous_faces(signs);
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> ring = corners_of(face);
    const auto corner = [&](int n) { return ring[static_cast<unsigned>(n) & 3U]; };
    for (int n = 0; n < 4; ++n) {
      if (is_inside(signs, corner(n - 1)) || !is_inside(signs, corner(n))) continue;
      int last = n;  // of the inside run; its edge leads outside
      if ((ambiguous & joined) >> face & 1U) {
        last = n - 2;
      } else {
        while (is_inside(signs, corner(last + 1))) ++last;
      }
      next[edge_between(corner(n - 1), corner(n))] = edge_between(corner(last), corner(last + 1));
    }
  }
  return next;
}

std::array<int, 8> groups(unsigned signs, unsigned joined) {
  std::array<int, 8> group{};
  std::iota(group.begin(), group.end(), 0);
  const auto unite = [&](int a, int b) {
    const int from = group[a];
    const int to = group[b];
    for (int& each : group) each = each == from ? to : each;
  };
  for (int edge = 0; edge < 12; ++edge) {
    if (!is_cut(signs, edge)) unite(lower_corner(edge), upper_corner(edge));
  }
  for (int face = 0; face < 6; ++face) {
    if (!(ambiguous_faces(signs) >> face & 1U)) continue;
    const std::array<int, 4> ring = corners_of(face);
    const bool even_inside = is_inside(signs, ring[0]);
    const int first = even_inside == ((joined >> face & 1U) != 0) ? 0 : 1;
    unite(ring[first], ring[first + 2]);
  }
  return group;
}

// A tunnel between the corners' groups a and b, of the sign `inside`, through the group `around`.
struct Passage {
  unsigned signs;
  unsigned joined;
  const std::array<int, 8>& group;
  bool inside;
  int a;
  int b;
  int around;
};

// The four lines of the cell along an axis; 0 and 3 stand across from each other, and so do 1 and 2.
std::array<int, 2> ends(int axis, int line) {
  const std::array<int, 2> across = others(axis);
  const int low = (line & 1) << across[0] | (line >> 1) << across[1];
  return {low, low | 1 << axis};
}

bool reaches(const Passage& passage, int axis, int line, int group) {
  const std::array<int, 2> corners = ends(axis, line);
  return passage.group[corners[0]] == group || passage.group[corners[1]] == group;
}

// Whether the face at `side` of the axis allows p r < q s there, for the values at the ends of the lines,
// taken positive where they have the sign that the tunnel joins.
bool parts(const Passage& passage, int axis, int side, const std::array<int, 4>& lines) {
  std::array<bool, 4> wanted{};
  for (int n = 0; n < 4; ++n)
    wanted[n] = is_inside(passage.signs, ends(axis, lines[n])[side]) == passage.inside;
  const auto [p, r, q, s] = wanted;
  if (p != r || (q == s && p == q)) return true;  // p r is not positive, or the signs leave it open
  if (q != s) return false;                       // p r > 0 > q s
  const bool joins_inside = (passage.joined >> (2 * axis + side) & 1U) != 0;
  return p != (joins_inside == passage.inside);
}

// In slices across the axis the surface is a hyperbola with p r - q s = 0 where it changes its type; for
// a tunnel this quadratic must be negative at both ends and positive between, in slices where p and r have
// the wanted sign and q and s have not.
bool passes(const Passage& passage, int axis) {
  for (const std::array<int, 4> lines : {std::array{0, 3, 1, 2}, std::array{1, 2, 0, 3}}) {
    const bool there =
        reaches(passage, axis, lines[0], passage.a) && reaches(passage, axis, lines[1], passage.b);
    const bool back =
        reaches(passage, axis, lines[0], passage.b) && reaches(passage, axis, lines[1], passage.a);
    const bool between =
        reaches(passage, axis, lines[2], passage.around) && reaches(passage, axis, lines[3], passage.around);
    if ((there || back) && between && parts(passage, axis, 0, lines) && parts(passage, axis, 1, lines))
      return true;
  }
  return false;
}

}  // namespace

Contours trace(unsigned signs, unsigned joined) {
  Contours contours;
  contours.group = groups(signs, joined);
  const std::array<int, 12> next = steps(signs, joined);
  std::array<bool, 12> seen{};
  for (int edge = 0; edge < 12; ++edge) {
    if (next[edge] < 0 || seen[edge]) continue;
    Loop loop;
    for (int at = edge; !seen[at]; at = next[at]) {
      seen[at] = true;
      loop.push_back(at);
    }
    contours.loops.push_back(loop);
  }
  return contours;
}

std::vector<Tunnel> tunnels(unsigned signs, unsigned joined, const Contours& contours) {
  const auto group_beside = [&](const Loop& loop, bool inside) {
    const int low = lower_corner(loop.front());
    return contours.group[is_inside(signs, low) == inside ? low : upper_corner(loop.front())];
  };
  std::vector<Tunnel> found;
  for (const bool inside : {true, false}) {
    for (std::size_t from = 0; from < contours.loops.size(); ++from) {
      for (std::size_t to = from + 1; to < contours.loops.size(); ++to) {
        const Passage passage{signs,
                              joined,
                              contours.group,
                              inside,
                              group_beside(contours.loops[from], inside),
                              group_beside(contours.loops[to], inside),
                              group_beside(contours.loops[from], !inside)};
        if (passage.around != group_beside(contours.loops[to], !inside)) continue;
        if (passage.a == passage.b) continue;
        if (passes(passage, 0) && passes(passage, 1) && passes(passage, 2))
          found.push_back({inside, static_cast<int>(from), static_cast<int>(to)});
      }
    }
  }
  return found;
}

}  // namespace footwall::isosurface::tables
