#include "engine/isosurface/bricks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "engine/isosurface/detail/threads.h"
#include "engine/isosurface/detail/triangles.h"
#include "engine/isosurface/detail/vertices.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

using namespace detail;

// What one plane of samples, and the cells above it, give.
struct PlaneContent {
  std::uint64_t vertices = 0;  // after numbering: of the planes before it
  std::uint64_t triangles = 0;
  std::vector<SlowCell> slow;
};

// Planes are worked on in runs, since each run looks at a plane more than it has.
struct Runs {
  Runs(std::int64_t planes_of, int threads) : planes(planes_of) {
    constexpr std::int64_t kRunsAThread = 8;
    constexpr std::int64_t kShortest = 4;
    length = threads == 1 ? planes : std::max(kShortest, planes / (kRunsAThread * threads));
    count = (planes + length - 1) / length;
  }
  std::int64_t first(std::int64_t run) const { return run * length; }
  std::int64_t last(std::int64_t run) const { return std::min(planes, (run + 1) * length); }

  std::int64_t planes;
  std::int64_t length = 1;
  std::int64_t count = 0;
};

// The active cells of two planes one after the other.
class ActivePair {
 public:
  ActivePair(const Frame& frame, const CellMasks& masks, const BitPlanes& planes)
      : frame_(&frame), masks_(&masks), planes_(&planes), before_(frame), here_(frame) {}

  void start(std::int64_t p) { find_active(*frame_, *masks_, *planes_, p - 1, here_); }
  // To the plane p, after start(p) or advance(p - 1).
  void advance(std::int64_t p) {
    std::swap(before_, here_);
    find_active(*frame_, *masks_, *planes_, p, here_);
  }
  const ActiveCells& before() const { return before_; }
  const ActiveCells& here() const { return here_; }

 private:
  const Frame* frame_;
  const CellMasks* masks_;
  const BitPlanes* planes_;
  ActiveCells before_;
  ActiveCells here_;
};

class Extraction {
 public:
  Extraction(const Frame& frame, const ExtractOptions& options, Surface& into)
      : frame_(frame),
        options_(options),
        into_(into),
        masks_(frame, options.bricks),
        runs_(frame.sample_planes, options.threads),
        planes_(static_cast<std::size_t>(frame.sample_planes)),
        centres_(static_cast<std::size_t>(runs_.count)) {}

  void run() {
    find_signs(frame_, masks_, options_.threads, signs_);
    for_each_in_parallel(runs_.count, options_.threads, [&](std::int64_t run, int) { count(run); });
    number();
    for_each_in_parallel(runs_.count, options_.threads, [&](std::int64_t run, int) { write(run); });
    for_each_in_parallel(runs_.count, options_.threads, [&](std::int64_t run, int) {
      write_centres(centres_[static_cast<std::size_t>(run)], into_.positions.data(),
                    options_.normals ? into_.normals.data() : nullptr);
    });
  }

 private:
  PlaneContent& plane(std::int64_t p) { return planes_[static_cast<std::size_t>(p)]; }

  void count(std::int64_t run) {
    ActivePair active(frame_, masks_, signs_);
    PlaneMasks edges(frame_);
    active.start(runs_.first(run));
    for (std::int64_t p = runs_.first(run); p < runs_.last(run); ++p) {
      active.advance(p);
      PlaneContent& content = plane(p);
      content.vertices = find_edges(frame_, signs_, p, active.before(), active.here(), edges);
      content.triangles = count_triangles(frame_, signs_, cases_, p, active.here(), content.slow);
      content.vertices += static_cast<std::uint64_t>(std::count_if(
          content.slow.begin(), content.slow.end(), [](const SlowCell& c) { return c.has_centre; }));
    }
  }

  // From the numbers of each plane to those of all before it, and the room for all.
  void number() {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    for (PlaneContent& content : planes_) {
      vertices += std::exchange(content.vertices, vertices);
      triangles += std::exchange(content.triangles, triangles);
    }
    if (vertices > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::kUnsupported, fmt::format("the isosurface would have {} vertices", vertices),
                  "at most 2^32 - 1 have numbers; take a part of the volume, or more ranks");
    }
    into_.positions.resize_uninitialised(vertices);
    into_.normals.resize_uninitialised(options_.normals ? vertices : 0);
    into_.keys.resize_uninitialised(options_.keys ? vertices : 0);
    into_.triangles.resize_uninitialised(triangles);
    into_.row_first.resize(static_cast<std::size_t>(frame_.cell_planes * frame_.cell_rows) + 1);
    into_.row_first.back() = triangles;
  }

  void write(std::int64_t run) {
    ActivePair active(frame_, masks_, signs_);
    PlaneMasks here(frame_);
    PlaneMasks next(frame_);
    VertexList list;
    std::vector<CentreLoop>& centres = centres_[static_cast<std::size_t>(run)];
    const std::int64_t end = runs_.last(run);
    active.start(runs_.first(run));
    // One plane ahead, since triangles name vertices of the plane after theirs.
    for (std::int64_t p = runs_.first(run); p <= std::min(end, frame_.cell_planes); ++p) {
      std::swap(here, next);
      active.advance(p);
      find_edges(frame_, signs_, p, active.before(), active.here(), next);
      count_centres(plane(p).slow, next);
      number_vertices(frame_, plane(p).vertices, next);
      if (p > runs_.first(run)) write_triangle_plane(here, next, centres);
      if (p < end) write_vertex_plane(next, list);
    }
  }

  void write_vertex_plane(const PlaneMasks& masks, VertexList& list) {
    const PlaneContent& content = plane(masks.p);
    list_vertices(frame_, masks, content.slow, list);
    const std::uint64_t first = content.vertices;
    write_vertices(frame_, masks.p, list, into_.positions.data() + first,
                   options_.normals ? into_.normals.data() + first : nullptr,
                   options_.keys ? into_.keys.data() + first : nullptr);
  }

  void write_triangle_plane(const PlaneMasks& here, const PlaneMasks& next,
                            std::vector<CentreLoop>& centres) {
    const PlaneContent& content = plane(here.p);
    const std::uint64_t end = plane(here.p + 1).triangles;  // there is a plane of samples after any cells
    write_triangles(frame_, signs_, cases_, here, next, content.slow, content.triangles,
                    into_.triangles.all().subspan(content.triangles, end - content.triangles),
                    into_.row_first.data() + here.p * frame_.cell_rows, centres);
  }

  const Frame& frame_;
  const ExtractOptions& options_;
  Surface& into_;
  CaseLookup cases_;
  CellMasks masks_;
  BitPlanes signs_;
  Runs runs_;
  std::vector<PlaneContent> planes_;
  std::vector<std::vector<CentreLoop>> centres_;  // per run
};

void make_empty(Surface& into) {
  into.positions.resize_uninitialised(0);
  into.normals.resize_uninitialised(0);
  into.triangles.resize_uninitialised(0);
  into.keys.resize_uninitialised(0);
  into.row_first.assign(static_cast<std::size_t>(into.cells.size(0) * into.cells.size(1)) + 1, 0);
}

}  // namespace

void extract_bricks(const Field& field, float isovalue, const ExtractOptions& options, Surface& into) {
  voxelize::apply_forced_simd();
  into.cells = options.cells.value_or(cells_of(field));
  if (into.cells.empty()) {
    make_empty(into);
    return;
  }
  const Frame frame(field, isovalue, into.cells);
  Extraction(frame, options, into).run();
}

}  // namespace footwall::isosurface
