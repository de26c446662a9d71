#include "engine/isosurface/tables/check.h"

#include <bit>
#include <cstdint>
#include <set>
#include <utility>

#include "engine/isosurface/tables/cell.h"
#include "engine/verify/trilinear_level_set.h"

namespace footwall::isosurface::tables {
namespace {

using Directed = std::pair<int, int>;

// In half edges of the cell, so that all is whole.
std::array<int, 3> doubled_place(int edge) {
  std::array<int, 3> at{};
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = (lower_corner(edge) >> axis & 1) + (upper_corner(edge) >> axis & 1);
  return at;
}

// Whether the corner of the face lies to the right of the way from a to b, as seen from outside the cell.
bool lies_right(int face, int a, int b, int corner) {
  const int axis = face / 2;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const std::array<int, 3> from = doubled_place(a);
  const std::array<int, 3> to = doubled_place(b);
  const int along_u = to[u] - from[u];
  const int along_v = to[v] - from[v];
  const int turn = along_u * (2 * (corner >> v & 1) - from[v]) - along_v * (2 * (corner >> u & 1) - from[u]);
  return (face & 1) != 0 ? turn < 0 : turn > 0;
}

int common_corner(int a, int b) {
  for (const int corner : {lower_corner(a), upper_corner(a)}) {
    if (corner == lower_corner(b) || corner == upper_corner(b)) return corner;
  }
  return -1;
}

// The boundary of the triangles on one face of the cell.
std::string face_fault(unsigned signs, bool joined, int face, const std::set<Directed>& border) {
  std::vector<Directed> here;
  for (const Directed& edge : border) {
    if ((faces_of(edge.first) & faces_of(edge.second)) >> face & 1U) here.push_back(edge);
  }
  unsigned cut = 0;
  int cuts = 0;
  for (int edge = 0; edge < 12; ++edge) {
    if ((faces_of(edge) >> face & 1U) == 0 || !is_cut(signs, edge)) continue;
    cut |= 1U << edge;
    ++cuts;
  }
  unsigned met = 0;
  for (const auto& [a, b] : here) {
    if (((met >> a | met >> b) & 1U) != 0) return "contours that meet on a face";
    met |= 1U << a | 1U << b;
    for (const int edge : {a, b}) {
      for (const int corner : {lower_corner(edge), upper_corner(edge)}) {
        // On an ambiguous face only the corner between the two ends is surely on one side.
        if (cuts == 4 && corner != common_corner(a, b)) continue;
        if (lies_right(face, a, b, corner) != is_inside(signs, corner))
          return "a contour turned the wrong way";
      }
    }
    if (cuts == 4) {
      const int corner = common_corner(a, b);
      if (corner < 0 || is_inside(signs, corner) == joined) return "a face joined the other way";
    }
  }
  return met == cut ? "" : "cut edges without a contour";
}

// Whether the triangles around each vertex form one fan, or one ring.
bool hangs_together(const Triangles& triangles, int vertex) {
  std::set<int> reached;
  std::size_t around = 0;
  for (const std::array<int, 3>& triangle : triangles) {
    bool uses = false;
    for (const int each : triangle) uses = uses || each == vertex;
    around += uses ? 1 : 0;
  }
  std::size_t passed = 0;
  std::set<std::size_t> used;
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t n = 0; n < triangles.size(); ++n) {
      std::vector<int> others;
      for (const int each : triangles[n]) {
        if (each != vertex) others.push_back(each);
      }
      if (others.size() != 2 || used.count(n) != 0) continue;
      if (passed != 0 && reached.count(others[0]) == 0 && reached.count(others[1]) == 0) continue;
      used.insert(n);
      reached.insert(others.begin(), others.end());
      ++passed;
      grown = true;
    }
  }
  return passed == around;
}

int parts_of(const Triangles& triangles) {
  std::vector<unsigned> parts;
  for (const auto& [a, b, c] : triangles) {
    unsigned merged = 1U << a | 1U << b | 1U << c;
    std::vector<unsigned> kept;
    for (const unsigned part : parts) {
      if ((part & merged) != 0) {
        merged |= part;
      } else {
        kept.push_back(part);
      }
    }
    kept.push_back(merged);
    parts = kept;
  }
  return static_cast<int>(parts.size());
}

}  // namespace

std::string fault_of(unsigned signs, unsigned alternative, const Entry& entry, bool chords) {
  const Triangles& triangles = entry.filling.triangles;
  std::set<Directed> directed;
  unsigned vertices = 0;
  unsigned beside_centre = 0;
  for (const std::array<int, 3>& triangle : triangles) {
    for (int n = 0; n < 3; ++n) {
      const Directed edge{triangle[n], triangle[(n + 1) % 3]};
      if (edge.first == edge.second || !directed.insert(edge).second) return "an edge used twice";
      vertices |= 1U << edge.first;
      if (edge.first == kCentreVertex) beside_centre |= 1U << edge.second;
    }
  }
  std::set<Directed> border;
  for (const Directed& edge : directed) {
    const bool inner = directed.count({edge.second, edge.first}) != 0;
    if (!inner) border.insert(edge);
    const bool at_centre = edge.first == kCentreVertex || edge.second == kCentreVertex;
    if (!inner && at_centre) return "an open edge inside the cell";
    const bool on_face = !at_centre && (faces_of(edge.first) & faces_of(edge.second)) != 0;
    if (!inner && !on_face) return "an open edge inside the cell";
    if (!inner || !on_face || chords) continue;
    const int face = std::countr_zero(faces_of(edge.first) & faces_of(edge.second));
    if (!may_be_chord(face, edge.first, edge.second)) return "a chord on a face that is the neighbour's";
  }
  unsigned wanted = entry.filling.centre_edges != 0 ? 1U << kCentreVertex : 0;
  for (int edge = 0; edge < 12; ++edge) wanted |= is_cut(signs, edge) ? 1U << edge : 0;
  if (vertices != wanted) return "vertices that are not the cut edges'";
  if (beside_centre != entry.filling.centre_edges) return "a centre beside other vertices than it says";
  for (int face = 0; face < 6; ++face) {
    const std::string fault = face_fault(signs, (alternative >> face & 1U) != 0, face, border);
    if (!fault.empty()) return fault;
  }
  int used = 0;
  for (int vertex = 0; vertex <= kCentreVertex; ++vertex) {
    if ((vertices >> vertex & 1U) == 0) continue;
    ++used;
    if (!hangs_together(triangles, vertex)) return "a vertex with two fans";
  }
  const auto edges = static_cast<int>((directed.size() + border.size()) / 2);
  if (used - edges + static_cast<int>(triangles.size()) != entry.loops - 2 * entry.tunnels)
    return "the wrong Euler number";
  if (parts_of(triangles) != entry.loops - entry.tunnels) return "the wrong number of parts";
  return "";
}

namespace {

// A generator of our own, so that every build looks at the same fields (a linear congruential one, Knuth).
class Random {
 public:
  std::uint64_t below(std::uint64_t bound) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return (state_ >> 33) % bound;
  }

 private:
  std::uint64_t state_ = 1;
};

std::array<double, 8> random_field(unsigned signs, Random& random) {
  // Now all of one size, now of very different sizes: tunnels want the latter.
  const std::uint64_t most = 1 + random.below(10);
  std::array<double, 8> values{};
  for (int corner = 0; corner < 8; ++corner) {
    const auto size = static_cast<double>(1 + random.below(std::uint64_t{2} << random.below(most + 1)));
    values[corner] = is_inside(signs, corner) ? size - 1 : -size;
  }
  return values;
}

// The parts above and below that an alternative means.
verify::LevelSet meaning(unsigned signs, unsigned alternative, const Entry& entry) {
  const Contours contours = trace(signs, alternative & 63U);
  std::set<int> inside;
  std::set<int> outside;
  for (int corner = 0; corner < 8; ++corner)
    (is_inside(signs, corner) ? inside : outside).insert(contours.group[corner]);
  return {entry.loops - 2 * entry.tunnels,
          static_cast<int>(inside.size()) - static_cast<int>(alternative >> 6 & 1U),
          static_cast<int>(outside.size()) - static_cast<int>(alternative >> 7 & 1U)};
}

}  // namespace

std::string fault_against_samples(const std::vector<SignCase>& all, int samples, int& met) {
  Random random;
  std::set<std::pair<unsigned, unsigned>> found;
  for (unsigned signs = 0; signs < 256; ++signs) {
    for (int n = 0; n < samples; ++n) {
      const std::array<double, 8> values = random_field(signs, random);
      unsigned joined = 0;
      for (int face = 0; face < 6; ++face) {
        const std::array<int, 4> ring = corners_of(face);
        if ((ambiguous_faces(signs) >> face & 1U) != 0 &&
            verify::face_joins_inside(values[ring[0]], values[ring[1]], values[ring[3]], values[ring[2]]))
          joined |= 1U << face;
      }
      const auto sampled = verify::trilinear_level_set(values);
      if (!sampled) continue;  // a saddle on the level
      int fitting = 0;
      for (const unsigned tunnel : {0U, 1U << 6, 1U << 7}) {
        const auto entry = all[signs].entries.find(joined | tunnel);
        if (entry == all[signs].entries.end() || meaning(signs, joined | tunnel, entry->second) != *sampled)
          continue;
        ++fitting;
        found.insert({signs, joined | tunnel});
      }
      if (fitting != 1)
        return "signs " + std::to_string(signs) + ", faces " + std::to_string(joined) + ": " +
               std::to_string(fitting) + " alternatives have the form of a sampled field (Euler number " +
               std::to_string(sampled->euler) + ")";
    }
  }
  met = static_cast<int>(found.size());
  return "";
}

}  // namespace footwall::isosurface::tables
