#include "engine/mesh/surface_facts.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "storage/base/error.h"

namespace footwall::mesh {
namespace {

using survey::Surface;
using survey::WorldPoint;
using FaceList = std::vector<std::array<std::int32_t, 3>>;

// Corner 3 f + k is vertex k of face f; the half-edge of that number runs from it to the next corner.
std::size_t next_corner(std::size_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}

class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);  // the smallest member stands for the group
  }

 private:
  std::vector<std::size_t> parent_;
};

struct Half {
  std::int32_t low, high;
  std::size_t corner;
  bool forward;
};

bool degenerate(const std::array<std::int32_t, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// Calls each(span of Half) for every edge of the faces that are not degenerate.
template <typename Each>
void for_each_edge(const FaceList& faces, const Each& each) {
  std::vector<Half> halves;
  halves.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (degenerate(faces[f])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = faces[f][k], b = faces[f][(k + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), 3 * f + k, a < b});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const Half& x, const Half& y) {
    return std::tie(x.low, x.high, x.corner) < std::tie(y.low, y.high, y.corner);
  });
  for (std::size_t first = 0; first < halves.size();) {
    std::size_t last = first + 1;
    while (last < halves.size() && halves[last].low == halves[first].low &&
           halves[last].high == halves[first].high)
      ++last;
    each(std::span<const Half>(halves).subspan(first, last - first));
    first = last;
  }
}

bool agree(std::span<const Half> edge) {
  return edge.size() == 2 && edge[0].forward != edge[1].forward;
}

// Joins the corners of two faces at both ends of their common edge.
void join_corners(Groups& corners, const Half& x, const Half& y) {
  if (x.forward != y.forward) {
    corners.join(x.corner, next_corner(y.corner));
    corners.join(next_corner(x.corner), y.corner);
  } else {
    corners.join(x.corner, y.corner);
    corners.join(next_corner(x.corner), next_corner(y.corner));
  }
}

void check(const Surface& surface) {
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    for (std::int32_t v : surface.triangles[f]) {
      if (v < 0 || static_cast<std::size_t>(v) >= surface.vertices.size())
        throw Error(ErrorCode::kFormat,
                    fmt::format("triangle {} of surface '{}' names vertex {}, which is not there", f,
                                surface.name, v));
      const WorldPoint& p = surface.vertices[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Error(ErrorCode::kFormat,
                    fmt::format("vertex {} of surface '{}' is not finite", v, surface.name));
    }
  }
}

double area_of(const WorldPoint& a, const WorldPoint& b, const WorldPoint& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

std::int64_t count_of(const std::vector<bool>& flags) {
  return std::count(flags.begin(), flags.end(), true);
}

}  // namespace

SurfaceFacts surface_facts(const Surface& surface) {
  check(surface);
  const FaceList& faces = surface.triangles;
  SurfaceFacts facts;
  facts.vertices = static_cast<std::int64_t>(surface.vertices.size());
  facts.faces = static_cast<std::int64_t>(faces.size());

  Groups pieces(faces.size()), fans(3 * faces.size());
  std::vector<std::size_t> border;
  std::int64_t edges = 0;
  for_each_edge(faces, [&](std::span<const Half> edge) {
    ++edges;
    if (edge.size() == 1) border.push_back(edge[0].corner);
    facts.nonmanifold_edges += edge.size() > 2;
    facts.inconsistent_edges += edge.size() == 2 && !agree(edge);
    for (const Half& h : edge.subspan(1)) {
      pieces.join(edge[0].corner / 3, h.corner / 3);
      join_corners(fans, edge[0], h);
    }
  });
  // A border edge joins the fans at its two ends into one loop.
  Groups loops(3 * faces.size());
  for (std::size_t h : border) loops.join(fans.of(h), fans.of(next_corner(h)));
  std::vector<bool> loop_seen(3 * faces.size(), false);
  for (std::size_t h : border) loop_seen[loops.of(fans.of(h))] = true;
  facts.boundary_loops = count_of(loop_seen);

  std::vector<bool> piece_seen(faces.size(), false), fan_seen(3 * faces.size(), false);
  std::vector<std::int32_t> fans_at(surface.vertices.size(), 0);
  std::int64_t sound_faces = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& t = faces[f];
    facts.area += area_of(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]);
    piece_seen[pieces.of(f)] = true;
    if (degenerate(t)) {
      ++facts.degenerate_faces;
      continue;
    }
    ++sound_faces;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t fan = fans.of(3 * f + k);
      if (!fan_seen[fan]) ++fans_at[t[k]];
      fan_seen[fan] = true;
    }
  }
  facts.components = count_of(piece_seen);
  facts.bow_tie_vertices =
      std::count_if(fans_at.begin(), fans_at.end(), [](std::int32_t n) { return n > 1; });
  const auto used = std::count_if(fans_at.begin(), fans_at.end(), [](std::int32_t n) { return n > 0; });
  facts.euler = used - edges + sound_faces;
  return facts;
}

std::vector<bool> faces_to_turn(const Surface& surface) {
  check(surface);
  // 1. What each face sees across its edges.
  struct Neighbour {
    std::size_t face;
    bool turned;
  };
  const std::size_t none = surface.triangles.size();
  std::vector<std::array<Neighbour, 3>> across(surface.triangles.size());
  for (auto& neighbours : across) neighbours.fill({none, false});
  for_each_edge(surface.triangles, [&](std::span<const Half> edge) {
    if (edge.size() != 2) return;
    const bool turned = !agree(edge);
    across[edge[0].corner / 3][edge[0].corner % 3] = {edge[1].corner / 3, turned};
    across[edge[1].corner / 3][edge[1].corner % 3] = {edge[0].corner / 3, turned};
  });
  // 2. Piece by piece: every face as the piece's first one sees it.
  std::vector<bool> turn(surface.triangles.size(), false), seen(surface.triangles.size(), false);
  std::vector<std::size_t> piece;
  for (std::size_t first = 0; first < surface.triangles.size(); ++first) {
    if (seen[first]) continue;
    piece.assign(1, first);
    seen[first] = true;
    bool twisted = false;
    for (std::size_t n = 0; n < piece.size(); ++n) {
      for (const Neighbour& neighbour : across[piece[n]]) {
        if (neighbour.face == none) continue;
        const bool as_seen = turn[piece[n]] != neighbour.turned;
        if (seen[neighbour.face]) {
          twisted = twisted || turn[neighbour.face] != as_seen;
          continue;
        }
        seen[neighbour.face] = true;
        turn[neighbour.face] = as_seen;
        piece.push_back(neighbour.face);
      }
    }
    // 3. The fewer ones are turned.
    const auto others = std::count_if(piece.begin(), piece.end(), [&](std::size_t f) { return turn[f]; });
    const bool most = 2 * static_cast<std::size_t>(others) > piece.size();
    for (const std::size_t f : piece) turn[f] = !twisted && turn[f] != most;
  }
  return turn;
}

CutSurface cut_into_manifold(const Surface& surface) {
  check(surface);
  const FaceList& faces = surface.triangles;
  std::vector<bool> alone(faces.size(), false);  // cut off all round
  CutSurface cut;
  for (bool sound = false; !sound;) {
    // 1. Join faces across every edge that two faces run in opposite directions.
    Groups corners(3 * faces.size()), pieces(faces.size());
    cut.cut_edges = 0;
    std::vector<std::size_t> twin(3 * faces.size(), 3 * faces.size());
    for_each_edge(faces, [&](std::span<const Half> edge) {
      if (agree(edge) && !alone[edge[0].corner / 3] && !alone[edge[1].corner / 3]) {
        join_corners(corners, edge[0], edge[1]);
        pieces.join(edge[0].corner / 3, edge[1].corner / 3);
        twin[edge[0].corner] = edge[1].corner;
        twin[edge[1].corner] = edge[0].corner;
      } else if (edge.size() > 1) {
        ++cut.cut_edges;
      }
    });
    // 2. One vertex for each fan; the first fan of a vertex keeps its number.
    const std::size_t vertices = surface.vertices.size();
    cut.faces.assign(faces.size(), {});
    cut.source_vertex.resize(vertices);
    std::iota(cut.source_vertex.begin(), cut.source_vertex.end(), 0);
    std::vector<bool> taken(vertices, false);
    std::vector<std::int32_t> number(3 * faces.size(), -1);
    for (std::size_t c = 0; c < 3 * faces.size(); ++c) {
      const std::size_t fan = corners.of(c);
      const std::int32_t v = faces[c / 3][c % 3];
      if (number[fan] < 0 && !taken[v]) {
        taken[v] = true;
        number[fan] = v;
      } else if (number[fan] < 0) {
        number[fan] = static_cast<std::int32_t>(cut.source_vertex.size());
        cut.source_vertex.push_back(v);
      }
      cut.faces[c / 3][c % 3] = number[fan];
    }
    cut.copied_vertices = static_cast<std::int64_t>(cut.source_vertex.size() - vertices);
    // 3. A cut edge may still have both ends in common, where the faces are joined the other way round its
    // ends:
    //    then its faces are cut off altogether. Each round cuts off at least one more face, so this ends.
    sound = true;
    for_each_edge(cut.faces, [&](std::span<const Half> edge) {
      if (edge.size() == 1 || (agree(edge) && twin[edge[0].corner] == edge[1].corner)) return;
      for (const Half& h : edge) alone[h.corner / 3] = true;
      sound = false;
    });
    std::vector<bool> seen(faces.size(), false);
    for (std::size_t f = 0; f < faces.size(); ++f) seen[pieces.of(f)] = true;
    cut.pieces = count_of(seen);
  }
  return cut;
}

}  // namespace footwall::mesh
