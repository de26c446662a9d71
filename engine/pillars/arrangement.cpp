#include "engine/pillars/arrangement.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/pillars/ties.h"
#include "storage/base/error.h"

namespace footwall::pillars {
namespace {

using survey::IndexPoint;

constexpr double kTieTakesNode = 4 * kTouch;      // a node this close to a tie gives way to it
constexpr double kTieTakesPoint = 0.25;           // so does a point between nodes
constexpr std::int64_t kMostPieces = 1 << 20;     // of one edge
constexpr std::size_t kMostVertices = 5'000'000;  // of a fault

IndexPoint between(const IndexPoint& a, const IndexPoint& b, double t) {
  return {a.i + t * (b.i - a.i), a.j + t * (b.j - a.j), a.k + t * (b.k - a.k)};
}

std::int64_t pieces_of(double length, double max_edge) {
  const double pieces = std::ceil(length / max_edge - 1e-9);
  if (!(pieces < double(kMostPieces)))
    throw Error(ErrorCode::kMemory,
                fmt::format("an edge of {:g} voxels would be cut into too many pieces", length),
                "ask for a larger --max-edge");
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(pieces));
}

class Builder {
 public:
  Builder(Arrangement& out, const Chart& chart, const Options& options, const JobContext& job)
      : out_(out), chart_(chart), options_(options), job_(job) {}

  void run(std::vector<std::string>& notes) {
    const std::size_t count = out_.courses.size();
    out_.tied.assign(count, false);
    out_.edge_counts.assign(count, 0);
    // 1. Ties first, so that courses can run through them.
    const std::vector<Tie> ties =
        ties_of(out_.courses, chart_, options_.tie_tolerance, options_.place_text, out_.mis_ties, job_);
    stops_.resize(count);
    for (const Tie& tie : ties) {
      std::vector<std::int64_t> ids;
      for (const auto& stop : tie.stops) ids.push_back(out_.courses[stop.first].id);
      std::sort(ids.begin(), ids.end());
      const std::int64_t owner = pair_id(ids[0], ids[1]);
      const std::int32_t vertex =
          add({MeshVertex::Kind::kPanel, owner, --tie_numbers_[owner], chart_.to_index(tie.point), -1},
              tie.point, true);
      for (const auto& [course, length] : tie.stops) {
        stops_[course].push_back({length, vertex});
        out_.tied[course] = true;
      }
      for (std::size_t m = 0; m < tie.stops.size(); ++m)
        for (std::size_t n = m + 1; n < tie.stops.size(); ++n)
          tied_pairs_.insert({tie.stops[m].first, tie.stops[n].first});
    }
    // 2. The courses themselves.
    for (std::size_t c = 0; c < count; ++c) lay_course(static_cast<std::int32_t>(c));
    // 3. Closing edges between neighbours of each family, then across the corners of two families.
    std::vector<std::int32_t> families[2];
    for (std::size_t c = 0; c < count; ++c)
      families[out_.courses[c].crosses].push_back(static_cast<std::int32_t>(c));
    const bool network = !families[1].empty();
    auto& main = families[0];
    for (std::size_t n = 0; n < main.size();) {
      const bool inner = n > 0 && n + 1 < main.size();
      if (out_.courses[main[n]].single() && inner) {
        if (!out_.tied[main[n]]) out_.lone.push_back(first_[main[n]]);
        main.erase(main.begin() + static_cast<std::ptrdiff_t>(n));
      } else {
        ++n;
      }
    }
    collect_obstacles();
    for (const auto& family : families)
      for (std::size_t n = 0; n + 1 < family.size(); ++n)
        for (int end = 0; end < 2; ++end) close(family[n], end, family[n + 1], end, network, notes);
    if (network && !main.empty()) {
      for (int m = 0; m < 2; ++m) {
        for (int n = 0; n < 2; ++n) {
          const std::int32_t a = m ? main.back() : main.front();
          const std::int32_t b = n ? families[1].back() : families[1].front();
          if (!tied_pairs_.contains({std::min(a, b), std::max(a, b)})) continue;
          // The corner where b's end on a's outer side and a's end on b's outer side are left.
          corner(a, b, m, n, notes);
        }
      }
    }
  }

 private:
  struct Stop {
    double length;
    std::int32_t vertex;
  };

  std::int32_t add(const MeshVertex& vertex, const ChartPoint& point, bool tie) {
    if (out_.vertices.size() >= kMostVertices)
      throw Error(ErrorCode::kMemory, "the fault would need more than 5 million vertices",
                  "ask for a larger --max-edge");
    out_.vertices.push_back(vertex);
    out_.points.push_back(point);
    out_.is_tie.push_back(tie);
    return static_cast<std::int32_t>(out_.vertices.size()) - 1;
  }

  void connect(std::int32_t a, std::int32_t b, const Strand& strand) {
    out_.edges.push_back({a, b});
    out_.strands.push_back(strand);
  }

  // Joins two vertices by a straight run of edges no longer than max_edge, whose points belong to `owner`.
  void run_between(std::int32_t a, std::int32_t b, const Strand& strand, std::int64_t owner) {
    const ChartPoint from = out_.points[a], to = out_.points[b];
    const IndexPoint start = out_.vertices[a].position, finish = out_.vertices[b].position;
    const std::int64_t pieces = pieces_of(space_distance(from, to), options_.max_edge);
    std::int32_t last = a;
    for (std::int64_t n = 1; n < pieces; ++n) {
      const double t = double(n) / double(pieces);
      const std::int32_t next =
          add({MeshVertex::Kind::kPanel, owner, numbers_[owner]++, between(start, finish, t), -1},
              pillars::between(from, to, t), false);
      connect(last, next, strand);
      last = next;
    }
    connect(last, b, strand);
  }

  // A course's vertices: its nodes, points that keep edges short, and ties in place of what is close to them.
  void lay_course(std::int32_t number) {
    const Course& c = out_.courses[number];
    const std::vector<double> lengths = chart_lengths(c);
    auto& stops = stops_[number];
    std::sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.length < b.length; });
    auto taken = [&](double length, double reach) {
      const auto it = std::lower_bound(stops.begin(), stops.end(), length - reach,
                                       [](const Stop& s, double value) { return s.length < value; });
      return it != stops.end() && it->length <= length + reach;
    };
    std::vector<Stop> chain(stops);
    std::int32_t n = 0;
    auto place = [&](const IndexPoint& position, const ChartPoint& point, double length, std::int64_t node,
                     double reach) {
      const std::int32_t mine = n++;
      if (taken(length, reach)) return;
      chain.push_back({length, add({MeshVertex::Kind::kPillar, c.id, mine, position, node}, point, false)});
    };
    for (std::size_t k = 0; k < c.points.size(); ++k) {
      place(c.positions[k], c.points[k], lengths[k], c.node_ids[k], kTieTakesNode);
      if (k + 1 == c.points.size()) break;
      const std::int64_t pieces = pieces_of(space_distance(c.points[k], c.points[k + 1]), options_.max_edge);
      for (std::int64_t m = 1; m < pieces; ++m) {
        const double t = double(m) / double(pieces);
        place(between(c.positions[k], c.positions[k + 1], t),
              pillars::between(c.points[k], c.points[k + 1], t),
              lengths[k] + t * (lengths[k + 1] - lengths[k]), -1, kTieTakesPoint);
      }
    }
    std::stable_sort(chain.begin(), chain.end(),
                     [](const Stop& a, const Stop& b) { return a.length < b.length; });
    first_.push_back(chain.front().vertex);
    last_.push_back(chain.back().vertex);
    const std::size_t before = out_.edges.size();
    const Strand strand{Strand::Kind::kPillar, number, number, 0};
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      const std::int32_t a = chain[k].vertex, b = chain[k + 1].vertex;
      const std::int64_t owner = out_.is_tie[a]   ? out_.vertices[a].owner
                                 : out_.is_tie[b] ? out_.vertices[b].owner
                                                  : 0;
      if (owner != 0) {
        run_between(a, b, strand,
                    owner);  // a tie moves in height and takes points away: edges may have grown
      } else {
        connect(a, b, strand);
      }
    }
    out_.edge_counts[number] = static_cast<std::int32_t>(out_.edges.size() - before);
  }

  struct Obstacle {
    std::int32_t a, b;  // vertices
    std::int32_t course;
    double low, high;
  };

  void add_obstacle(std::int32_t a, std::int32_t b, std::int32_t course) {
    const double x = out_.points[a].strike, y = out_.points[b].strike;
    obstacles_.push_back({a, b, course, std::min(x, y), std::max(x, y)});
  }

  void collect_obstacles() {
    for (std::size_t e = 0; e < out_.edges.size(); ++e)
      add_obstacle(out_.edges[e][0], out_.edges[e][1], out_.strands[e].a);
    for (std::size_t c = 0; c < first_.size(); ++c)
      if (out_.courses[c].single()) add_obstacle(first_[c], first_[c], static_cast<std::int32_t>(c));
  }

  // The first obstacle that a straight edge between two vertices would run into; -1 none, -2 another closing
  // edge.
  std::optional<std::int32_t> obstacle_between(std::int32_t a, std::int32_t b) const {
    const ChartPoint p = out_.points[a], q = out_.points[b];
    const double low = std::min(p.strike, q.strike) - kTouch, high = std::max(p.strike, q.strike) + kTouch;
    for (const Obstacle& o : obstacles_) {
      if (o.high < low || o.low > high) continue;
      const bool at_a = o.a == a || o.b == a, at_b = o.a == b || o.b == b;
      if (at_a && at_b && o.a != o.b) return o.course;  // the edge is there already
      if (o.a == o.b && (at_a || at_b)) continue;
      const ChartPoint r = out_.points[o.a], s = out_.points[o.b];
      const Meetings m = meetings_of(p, q, r, s);
      for (int k = 0; k < m.count; ++k) {
        // Meeting in the common vertex is what neighbours do.
        const double u = m.at[static_cast<std::size_t>(k)].u;
        const ChartPoint where = pillars::between(p, q, u);
        if (at_a && chart_distance(where, p) < 2 * kTouch) continue;
        if (at_b && chart_distance(where, q) < 2 * kTouch) continue;
        return o.course;
      }
    }
    return std::nullopt;
  }

  bool try_close(std::int32_t a, std::int32_t p, std::int32_t b, std::int32_t q, int end,
                 std::int32_t& blocker) {
    job_.check();
    if (p == q || chart_distance(out_.points[p], out_.points[q]) < kTouch) return true;
    const auto obstacle = obstacle_between(p, q);
    if (obstacle) {
      blocker = *obstacle;
      return false;
    }
    if (out_.courses[b].id < out_.courses[a].id) std::swap(a, b), std::swap(p, q);
    const Strand strand{Strand::Kind::kClosing, a, b, end};
    run_between(p, q, strand, pair_id(out_.courses[a].id, out_.courses[b].id));
    add_obstacle(p, q, -1);
    return true;
  }

  void close(std::int32_t a, int end_a, std::int32_t b, int end_b, bool network,
             std::vector<std::string>& notes) {
    std::int32_t blocker = -1;
    // Two single nodes, or pillars that share this end, have only one edge, or none, between them.
    if (end_a == 1 && out_.courses[a].single() && out_.courses[b].single()) return;
    if (try_close(a, end_a ? last_[a] : first_[a], b, end_b ? last_[b] : first_[b], end_a, blocker)) return;
    const std::string what =
        fmt::format("no edge joins the {} of pillars '{}' and '{}', {} lies in its way",
                    end_a ? "far ends" : "near ends", out_.courses[a].name, out_.courses[b].name,
                    blocker < 0 ? std::string("another such edge")
                                : fmt::format("pillar '{}'", out_.courses[blocker].name));
    const bool same_family = blocker >= 0 && out_.courses[blocker].crosses == out_.courses[a].crosses;
    if (!network && (same_family || blocker < 0))
      throw Error(ErrorCode::kInvalid, what,
                  "the pillars' order along the fault is not clear there: move or delete one");
    notes.push_back(what);
  }

  void corner(std::int32_t a, std::int32_t b, int a_is_last, int b_is_last, std::vector<std::string>& notes) {
    // Main courses run in the direction in which crossing ones are ordered, and the other way round.
    std::int32_t blocker = -1;
    const std::int32_t p = b_is_last ? last_[a] : first_[a], q = a_is_last ? last_[b] : first_[b];
    if (out_.is_tie[p] || out_.is_tie[q]) return;  // nothing sticks out there
    if (!try_close(a, p, b, q, 2 + 2 * a_is_last + b_is_last, blocker))
      notes.push_back(fmt::format("the corner between pillars '{}' and '{}' stays open", out_.courses[a].name,
                                  out_.courses[b].name));
  }

  Arrangement& out_;
  const Chart& chart_;
  const Options& options_;
  const JobContext& job_;
  std::vector<std::vector<Stop>> stops_;
  std::vector<std::int32_t> first_, last_;  // end vertices of each course
  std::set<std::pair<std::int32_t, std::int32_t>> tied_pairs_;
  std::map<std::int64_t, std::int32_t> numbers_, tie_numbers_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace

Arrangement arrange(std::vector<Course> courses, const Chart& chart, const Options& options,
                    std::vector<std::string>& notes, const JobContext& job) {
  Arrangement out;
  out.courses = std::move(courses);
  Builder(out, chart, options, job).run(notes);
  return out;
}

}  // namespace footwall::pillars
