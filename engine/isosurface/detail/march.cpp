#include "engine/isosurface/detail/march.h"

#include <algorithm>

namespace footwall::isosurface::detail {

March::March(const Frame& frame, const CellMasks& masks, const CaseLookup& cases, std::int64_t planes,
             std::uint64_t* row_first, Besides& besides)
    : frame_(frame), masks_(masks), cases_(cases), row_first_(row_first), besides_(besides), signs_(frame) {
  for (std::int64_t n = 0; n < planes + 2; ++n) planes_.emplace_back(frame);
}

Count March::find(const Run& run) {
  run_ = run;
  if (found_ != run.first) {
    // The cells before the run share edges with its first plane.
    scanned_ = run.first - 2;
    scan_to(run.first);
    find_active(frame_, masks_, signs_, run.first - 1, plane(run.first - 1).cells, ahead_);
    found_ = run.first - 1;
  }
  // One plane more than the run has, since triangles name vertices of the plane after theirs.
  while (found_ < std::min(run.last, frame_.cell_planes)) {
    // One more than is needed for signs: the gradients of vertices need its samples in the cache.
    scan_to(std::min(found_ + 3, run.last + 1));
    find_plane(++found_);
  }
  Count count;
  for (std::int64_t p = run.first; p < run.last; ++p) {
    count.vertices += plane(p).vertices;
    count.triangles += plane(p).triangles;
  }
  return count;
}

void March::scan_to(std::int64_t p) {
  for (; scanned_ < p; ++scanned_) {
    const std::int64_t next = scanned_ + 1;
    if (next >= 0 && next < frame_.sample_planes) signs_.scan(frame_, masks_, next, ahead_);
  }
}

void March::find_plane(std::int64_t p) {
  Plane& here = plane(p);
  find_active(frame_, masks_, signs_, p, here.cells, ahead_);
  here.vertices = find_edges(frame_, signs_, p, plane(p - 1).cells, here.cells, here.edges, ahead_);
  here.slow.clear();
  here.triangles = count_triangles(frame_, signs_, cases_, p, here.cells, here.slow);
  here.vertices += count_centres(here.slow, here.edges);
}

void March::write(const Place& place) {
  // A run that goes on where the last one ended finds its first plane numbered.
  if (numbered_ != run_.first) number_vertices(frame_, place.vertex, plane(run_.first).edges);
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (std::int64_t p = run_.first; p < run_.last; ++p) {
    const Plane& here = plane(p);
    if (p < frame_.cell_planes) {
      PlaneMasks& upper = plane(p + 1).edges;
      number_vertices(frame_, place.vertex + vertices + here.vertices, upper);
      write_triangles(frame_, cases_, here.cells, here.edges, upper, here.slow, place.triangle + triangles,
                      {place.triangles + triangles, here.triangles}, row_first_ + p * frame_.cell_rows,
                      besides_.centres, ahead_);
    }
    list_vertices(frame_, here.edges, here.slow, list_);
    write_vertices(frame_, p, list_, place.positions + vertices,
                   place.normals == nullptr ? nullptr : place.normals + vertices,
                   place.keys == nullptr ? nullptr : place.keys + vertices, ahead_);
    vertices += here.vertices;
    triangles += here.triangles;
  }
  numbered_ = run_.last;
}

void March::list_parts(const Place& place) {
  std::uint64_t triangle = place.triangle;
  for (std::int64_t p = run_.first; p < std::min(run_.last, frame_.cell_planes); ++p) {
    const Plane& here = plane(p);
    list_part_runs(frame_, cases_, here.cells, p, here.slow, triangle, besides_.part_runs);
    triangle += here.triangles;
  }
}

}  // namespace footwall::isosurface::detail
