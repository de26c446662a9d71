// The pillars of a fault as a planar graph in its chart: resampled courses, tied where they cross, and
// closing edges from end to end of neighbours.
#pragma once
#include <vector>

#include "engine/pillars/course.h"
#include "engine/pillars/planar.h"
#include "engine/pillars/triangulate.h"

namespace footwall::pillars {

// What a graph edge belongs to.
struct Strand {
  enum class Kind : std::uint8_t { kPillar, kClosing };
  Kind kind = Kind::kPillar;
  std::int32_t a = 0;  // course; of a closing edge the one of smaller id
  std::int32_t b = 0;  // of a closing edge the other course; otherwise equal to a
  int end = 0;         // of a closing edge: tells those of the same pair apart
  friend auto operator<=>(const Strand&, const Strand&) = default;
};

struct Arrangement {
  std::vector<Course> courses;
  std::vector<MeshVertex> vertices;
  std::vector<ChartPoint> points;  // of the vertices
  std::vector<bool> is_tie;        // of the vertices
  std::vector<PointEdge> edges;
  std::vector<Strand> strands;            // of the edges
  std::vector<std::int32_t> lone;         // single-node pillars inside the fault
  std::vector<std::int32_t> edge_counts;  // graph edges of each course
  std::vector<bool> tied;                 // courses that are tied to another
  std::vector<MisTie> mis_ties;
};

// Throws Error kInvalid naming the pillars that cross beyond the tolerance or lie on one another.
Arrangement arrange(std::vector<Course> courses, const Chart& chart, const Options& options,
                    std::vector<std::string>& notes, const JobContext& job);

}  // namespace footwall::pillars
