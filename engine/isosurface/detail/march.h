// The way through the planes of a volume, from samples to triangles, in runs of planes: first all that a run
// has is found and counted, then, when the numbers of what lies before it are known, written at its place.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/detail/lines_ahead.h"
#include "engine/isosurface/detail/triangles.h"
#include "engine/isosurface/detail/vertices.h"

namespace footwall::isosurface::detail {

// Planes of samples [first, last) of the frame, with the cells between each and the next one.
struct Run {
  std::int64_t first = 0;
  std::int64_t last = 0;
};
struct Count {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
};
// The numbers of a run's first vertex and triangle, and where they go; normals and keys may be null.
struct Place {
  std::uint64_t vertex = 0;
  std::uint64_t triangle = 0;
  Point* positions = nullptr;
  Point* normals = nullptr;
  VertexKey* keys = nullptr;
  Triangle* triangles = nullptr;
};

// What a thread's runs give besides what has a place of its own.
struct Besides {
  std::vector<CentreLoop> centres;  // not made: the last ones hang on vertices of the next run
  std::vector<PartRun> part_runs;
};

class March {
 public:
  // Runs are to have up to `planes` planes. row_first: as in Surface.
  March(const Frame& frame, const CellMasks& masks, const CaseLookup& cases, std::int64_t planes,
        std::uint64_t* row_first, Besides& besides);

  // Costs less where the run follows that of the call before.
  Count find(const Run& run);
  // What was found last.
  void write(const Place& place);
  // Where the bricks' triangles of the same are.
  void list_parts(const Place& place);

 private:
  struct Plane {
    explicit Plane(const Frame& frame) : cells(frame), edges(frame) {}
    ActiveCells cells;  // between this plane of samples and the next one
    PlaneMasks edges;
    std::vector<SlowCell> slow;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
  };
  Plane& plane(std::int64_t p) { return planes_[static_cast<std::size_t>(p + 1) % planes_.size()]; }
  void scan_to(std::int64_t p);
  void find_plane(std::int64_t p);

  const Frame& frame_;
  const CellMasks& masks_;
  const CaseLookup& cases_;
  std::uint64_t* row_first_;
  Besides& besides_;
  BitPlanes signs_;
  LinesAhead ahead_;
  std::vector<Plane> planes_;  // one before the run's, and one after
  Run run_;
  std::int64_t scanned_ = -2;  // the last plane that is
  std::int64_t found_ = -2;
  std::int64_t numbered_ = -2;
  VertexList list_;
};

}  // namespace footwall::isosurface::detail
