#include "engine/pillars/triangulate.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/pillars/arrangement.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"

namespace footwall::pillars {
namespace {

constexpr std::int64_t kReadableIds = std::int64_t{1} << 31;

std::int64_t hashed_id(std::span<const std::int64_t> key) {
  return -1 - static_cast<std::int64_t>(hash64(std::as_bytes(key)) >> 1);
}

// A region with what bounds it.
struct Cell {
  const Region* region = nullptr;
  std::int64_t id = 0;
  std::set<std::int32_t> courses;
  bool strip = false;
};

class Weaver {
 public:
  Weaver(Arrangement arrangement, const Chart& chart, const Options& options, const JobContext& job)
      : a_(std::move(arrangement)), chart_(chart), options_(options) {
    regions_ = regions_of(a_.points, a_.edges, a_.lone, job);
    for (std::size_t e = 0; e < a_.edges.size(); ++e) {
      const auto [low, high] = std::minmax(a_.edges[e][0], a_.edges[e][1]);
      strand_of_[{low, high}] = a_.strands[e];
    }
  }

  // Rim edges with a region on one side only, directed.
  std::vector<PointEdge> border() const {
    std::set<PointEdge> rims;
    for (const Region& r : regions_) rims.insert(r.rim.begin(), r.rim.end());
    std::vector<PointEdge> alone;
    for (const PointEdge& e : rims)
      if (!rims.contains({e[1], e[0]})) alone.push_back(e);
    return alone;
  }

  // Twice the surface's vector area, which its border alone decides.
  Vector3 vector_area() const {
    Vector3 sum{0, 0, 0};
    for (const PointEdge& e : border()) {
      const auto &p = a_.vertices[e[0]].position, &q = a_.vertices[e[1]].position;
      const Vector3 u{p.i - chart_.origin[0], p.j - chart_.origin[1], p.k - chart_.origin[2]};
      const Vector3 v{q.i - chart_.origin[0], q.j - chart_.origin[1], q.k - chart_.origin[2]};
      sum[0] += u[1] * v[2] - u[2] * v[1];
      sum[1] += u[2] * v[0] - u[0] * v[2];
      sum[2] += u[0] * v[1] - u[1] * v[0];
    }
    return sum;
  }

  FaultMesh weave(std::vector<std::string> notes, const JobContext& job) {
    FaultMesh mesh;
    mesh.chart = chart_;
    mesh.mis_ties = a_.mis_ties;
    mesh.notes = std::move(notes);
    for (const MisTie& tie : mesh.mis_ties)
      if (tie.distance > 0.01)
        mesh.notes.push_back(
            fmt::format("pillars '{}' and '{}' cross {:.2f} voxels apart and were tied half-way",
                        name_of(tie.pillar_a), name_of(tie.pillar_b), tie.distance));
    if (regions_.empty())
      throw Error(ErrorCode::kInvalid, "the pillars enclose no area", "pick longer pillars, or more of them");
    check_use(mesh.notes);
    check_fans();
    if (const int parts = count_parts(); parts > 1)
      mesh.notes.push_back(fmt::format("the surface falls into {} separate parts", parts));

    const std::vector<Cell> cells = identify();
    // 1. The pillars' own vertices that a panel uses.
    std::vector<std::int32_t> number(a_.vertices.size(), -1);
    for (const Region& r : regions_) {
      for (const PointEdge& e : r.rim) number[e[0]] = 0;
      for (const PointEdge& e : r.inner) number[e[0]] = number[e[1]] = 0;
      for (std::int32_t p : r.points) number[p] = 0;
    }
    std::map<std::int64_t, std::int32_t> next;  // after the points of closing edges
    for (std::size_t v = 0; v < number.size(); ++v) {
      const MeshVertex& vertex = a_.vertices[v];
      if (vertex.kind == MeshVertex::Kind::kPanel)
        next[vertex.owner] = std::max(next[vertex.owner], vertex.n + 1);
      if (number[v] < 0) continue;
      number[v] = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.push_back(vertex);
    }
    // 2. Each panel by itself.
    const auto given = static_cast<std::int32_t>(a_.points.size());
    FillOptions fill{options_.detail, options_.max_edge, 5'000'000};
    double least = 0;
    for (const Cell& cell : cells) least += least_points(*cell.region, a_.points, fill.max_edge);
    if (least > static_cast<double>(fill.most_points)) throw too_many_vertices();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c % 16 == 0)
        job.report(double(c) / double(cells.size()), "triangulate",
                   fmt::format("{} of {} panels", c, cells.size()));
      const Cell& cell = cells[c];
      const std::unique_ptr<Reference> reference = reference_of(cell, mesh.notes);
      const Filling filling = fill_region(*cell.region, a_.points, reference.get(), fill, job);
      fill.most_points -= std::min(fill.most_points, filling.added.size());
      const auto first = static_cast<std::int32_t>(mesh.vertices.size());
      std::int32_t n = next[cell.id];
      for (const ChartPoint& p : filling.added)
        mesh.vertices.push_back({MeshVertex::Kind::kPanel, cell.id, n++, chart_.to_index(p), -1});
      std::int32_t f = 0;
      for (const auto& face : filling.faces) {
        MeshFace out{cell.id, f++, {}};
        for (std::size_t k = 0; k < 3; ++k)
          out.vertices[k] = face[k] < given ? number[face[k]] : first + face[k] - given;
        mesh.faces.push_back(out);
      }
      Panel panel{cell.id, {}, cell.strip};
      for (std::int32_t course : cell.courses) panel.pillars.push_back(a_.courses[course].id);
      std::sort(panel.pillars.begin(), panel.pillars.end());
      mesh.panels.push_back(std::move(panel));
    }
    job.report(1, "triangulate", fmt::format("{} of {} panels", cells.size(), cells.size()));
    return mesh;
  }

 private:
  const Strand& strand(const PointEdge& e) const {
    return strand_of_.at({std::min(e[0], e[1]), std::max(e[0], e[1])});
  }

  std::string name_of(std::int64_t id) const {
    for (const Course& c : a_.courses)
      if (c.id == id) return c.name;
    return std::to_string(id);
  }

  // Pillars, or parts of them, that no panel reaches.
  void check_use(std::vector<std::string>& notes) const {
    std::vector<std::int32_t> used(a_.courses.size(), 0);
    std::set<PointEdge> seen;
    std::set<std::int32_t> reached;
    for (const Region& r : regions_) {
      for (const auto* edges : {&r.rim, &r.inner}) {
        for (const PointEdge& e : *edges) {
          reached.insert(e.begin(), e.end());
          if (!seen.insert({std::min(e[0], e[1]), std::max(e[0], e[1])}).second) continue;
          if (strand(e).kind == Strand::Kind::kPillar) ++used[strand(e).a];
        }
      }
      reached.insert(r.points.begin(), r.points.end());
    }
    for (std::int32_t p : a_.lone)
      if (!reached.contains(p))
        throw Error(ErrorCode::kInvalid,
                    fmt::format("the single node of pillar '{}' lies beyond its neighbours' ends",
                                name_of(a_.vertices[p].owner)),
                    "give the pillar a second node, or delete it");
    for (std::size_t c = 0; c < used.size(); ++c) {
      if (a_.courses[c].single() || used[c] == a_.edge_counts[c]) continue;
      notes.push_back(used[c] == 0
                          ? fmt::format("pillar '{}' bounds no panel", a_.courses[c].name)
                          : fmt::format("a part of pillar '{}' bounds no panel", a_.courses[c].name));
    }
  }

  int count_parts() const {
    std::map<PointEdge, std::size_t> owner;
    for (std::size_t r = 0; r < regions_.size(); ++r)
      for (const PointEdge& e : regions_[r].rim) owner[e] = r;
    std::vector<bool> reached(regions_.size(), false);
    int parts = 0;
    for (std::size_t start = 0; start < regions_.size(); ++start) {
      if (reached[start]) continue;
      ++parts;
      std::vector<std::size_t> queue{start};
      reached[start] = true;
      while (!queue.empty()) {
        const Region& region = regions_[queue.back()];
        queue.pop_back();
        for (const PointEdge& e : region.rim) {
          const auto other = owner.find({e[1], e[0]});
          if (other == owner.end() || reached[other->second]) continue;
          reached[other->second] = true;
          queue.push_back(other->second);
        }
      }
    }
    return parts;
  }

  // A vertex from which two borders leave joins parts of the surface in one point only.
  void check_fans() const {
    std::set<std::int32_t> left;
    for (const PointEdge& e : border()) {
      if (left.insert(e[0]).second) continue;
      std::set<std::string> names;
      for (std::size_t n = 0; n < a_.edges.size(); ++n)
        if (a_.edges[n][0] == e[0] || a_.edges[n][1] == e[0])
          for (std::int32_t c : {a_.strands[n].a, a_.strands[n].b})
            names.insert("'" + a_.courses[c].name + "'");
      throw Error(ErrorCode::kInvalid,
                  fmt::format("the surface between pillars {} would be pinched to one point near {}",
                              fmt::join(names, ", "), options_.place_text(a_.vertices[e[0]].position)),
                  "uncross the pillars there, or add one beside the crossing");
    }
  }

  std::vector<Cell> identify() const {
    std::vector<Cell> cells;
    std::set<std::int64_t> ids;
    for (const Region& region : regions_) {
      Cell cell;
      cell.region = &region;
      std::map<std::int32_t, std::int32_t> edges;
      std::set<std::vector<std::int64_t>> bounds;
      for (const PointEdge& e : region.rim) {
        const Strand& s = strand(e);
        cell.courses.insert({s.a, s.b});
        if (s.kind == Strand::Kind::kPillar) {
          ++edges[s.a];
          bounds.insert({1, a_.courses[s.a].id});
        } else {
          bounds.insert({2, a_.courses[s.a].id, a_.courses[s.b].id, s.end});
        }
        if (a_.is_tie[e[0]]) bounds.insert({3, a_.vertices[e[0]].owner, a_.vertices[e[0]].n});
      }
      cell.strip = cell.courses.size() == 2 && region.inner.empty() && region.points.empty();
      for (std::int32_t c : cell.courses)
        cell.strip = cell.strip && !a_.tied[c] && edges[c] == a_.edge_counts[c];
      for (const PointEdge& e : region.inner) cell.courses.insert({strand(e).a, strand(e).b});
      if (cell.strip) {
        cell.id = pair_id(a_.courses[*cell.courses.begin()].id, a_.courses[*cell.courses.rbegin()].id);
      } else {
        std::vector<std::int64_t> key;
        for (const auto& b : bounds) key.insert(key.end(), b.begin(), b.end());
        cell.id = hashed_id(key);
      }
      for (std::int32_t p : region.points) {
        for (std::size_t c = 0; c < a_.courses.size(); ++c)
          if (a_.courses[c].id == a_.vertices[p].owner) cell.courses.insert(static_cast<std::int32_t>(c));
      }
      while (!ids.insert(cell.id).second) cell.id = hashed_id(std::array{cell.id});
      cells.push_back(std::move(cell));
    }
    std::sort(cells.begin(), cells.end(), [](const Cell& x, const Cell& y) { return x.id < y.id; });
    return cells;
  }

  std::unique_ptr<Reference> reference_of(const Cell& cell, std::vector<std::string>& notes) const {
    if (cell.strip) {
      const Course &a = a_.courses[*cell.courses.begin()], &b = a_.courses[*cell.courses.rbegin()];
      if (auto ruled = ruled_surface(a, b)) return ruled;
      if (auto ruled = ruled_surface(b, a)) return ruled;
      notes.push_back(
          fmt::format("between pillars '{}' and '{}' lines at equal length would overtake each other in the "
                      "chart; the panel is smoothed from its rim instead",
                      a.name, b.name));
    }
    // With a pillar's end, a lone node or a hole inside, nothing smooth passes through all of it.
    if (!cell.region->inner.empty() || !cell.region->points.empty()) return nullptr;
    const std::vector<ChartPoint> loop = loop_of(cell.region->rim);
    return loop.empty() ? nullptr : mean_value_surface(loop);
  }

  // The rim's points in their order round the region; empty unless it is one simple loop.
  std::vector<ChartPoint> loop_of(const std::vector<PointEdge>& rim) const {
    std::map<std::int32_t, std::int32_t> next;
    for (const PointEdge& e : rim)
      if (!next.emplace(e[0], e[1]).second) return {};
    std::vector<ChartPoint> loop;
    for (std::int32_t p = rim[0][0]; loop.empty() || p != rim[0][0]; p = next.at(p))
      loop.push_back(a_.points[p]);
    if (loop.size() != rim.size()) loop.clear();
    return loop;
  }

  Arrangement a_;
  Chart chart_;
  Options options_;
  std::vector<Region> regions_;
  std::map<PointEdge, Strand> strand_of_;
};

// The same plane seen from its other side.
Chart turned(Chart chart) {
  for (double& c : chart.normal) c = 0.0 - c;
  for (double& c : chart.strike) c = 0.0 - c;
  chart.along[0] = 0.0 - chart.along[0];
  if (std::abs(chart.along[0]) > std::abs(chart.along[1]) && chart.along[0] < 0)
    chart.along = {0.0 - chart.along[0], 0.0 - chart.along[1]};
  return chart;
}

bool points_backwards(const Vector3& v) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (double c : v)
    if (std::abs(c) > 1e-9 * length) return c < 0;
  return false;
}

}  // namespace

std::int64_t pair_id(std::int64_t pillar_a, std::int64_t pillar_b) {
  const auto [low, high] = std::minmax(pillar_a, pillar_b);
  if (low >= 0 && high < kReadableIds) return low * kReadableIds + high;
  return hashed_id(std::array{low, high});
}

namespace {

// The surface in one frame. turns: whether the frame may be turned round for the normal's sign.
FaultMesh woven(std::span<const PillarInput> pillars, const Options& options, Chart frame, bool turns,
                const JobContext& job) {
  auto weaver_for = [&](std::vector<std::string>& notes) {
    return Weaver(
        arrange(courses_of(pillars, frame, notes, options.place_text, job), frame, options, notes, job),
        frame, options, job);
  };
  std::vector<std::string> notes;
  Weaver weaver = weaver_for(notes);
  if (!turns || !points_backwards(weaver.vector_area())) return weaver.weave(std::move(notes), job);
  // The chart's normal has the wanted sign, the surface's mean normal has not: from the other side it has.
  frame = turned(frame);
  notes.clear();
  return weaver_for(notes).weave(std::move(notes), job);
}

}  // namespace

FaultMesh triangulate(std::span<const PillarInput> pillars, const Options& options,
                      const std::optional<Chart>& chart, const JobContext& job) {
  for (const auto& [name, value] : {std::pair{"--detail", options.detail}, {"--max-edge", options.max_edge}})
    if (!(value >= kTouch) || !std::isfinite(value))
      throw Error(ErrorCode::kUsage, fmt::format("{} must be at least 1/256 voxel", name));
  if (!(options.tie_tolerance >= 0)) throw Error(ErrorCode::kUsage, "the tie tolerance must not be negative");
  if (pillars.size() < 2)
    throw Error(ErrorCode::kInvalid,
                fmt::format("the fault has {} pillar(s), a surface needs two", pillars.size()),
                "pick the fault on another section");
  const bool stored = chart && !chart->empty();
  try {
    return woven(pillars, options, stored ? *chart : fit_chart(pillars), !stored, job);
  } catch (const Error& refused) {
    if (refused.code() != ErrorCode::kInvalid || pillars.size() < 3) throw;
    // Perhaps it is only the frame that does not suit them (any more).
    std::vector<Chart> others;
    if (stored) others.push_back(fit_chart(pillars));
    if (const auto across = fit_chart_across(pillars)) others.push_back(*across);
    for (const Chart& other : others) {
      try {
        return woven(pillars, options, other, true, job);
      } catch (const Error& again) {
        if (again.code() != ErrorCode::kInvalid) throw;
      }
    }
    throw;
  }
}

}  // namespace footwall::pillars
