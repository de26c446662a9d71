#include "engine/isosurface/bricks.h"

#include <algorithm>
#include <array>
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

[[noreturn]] void refuse_vertices() {
  throw Error(ErrorCode::kUnsupported, "the isosurface would have more than 2^32 - 1 vertices",
              "take a part of the volume, or more ranks");
}

// Planes of samples [first, last) that one thread works through.
struct Run {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

// As many runs as threads, of about equal work as far as the bricks tell.
std::vector<Run> runs_of(const Frame& frame, const CellMasks& masks, int threads) {
  const auto planes = static_cast<std::size_t>(frame.sample_planes);
  std::vector<double> work(planes + 1, 0);
  for (std::size_t p = 0; p < planes; ++p) {
    const auto cell_plane = std::min(static_cast<std::int64_t>(p), frame.cell_planes - 1);
    work[p + 1] = work[p] + masks.work(cell_plane);
  }
  std::vector<Run> runs;
  std::int64_t first = 0;
  for (int n = 1; n <= threads && first < frame.sample_planes; ++n) {
    const double goal = work.back() * n / threads;
    auto last = static_cast<std::int64_t>(std::lower_bound(work.begin(), work.end(), goal) - work.begin());
    last = n == threads ? frame.sample_planes : std::clamp(last, first, frame.sample_planes);
    if (last > first) runs.push_back({first, last});
    first = last;
  }
  return runs;
}

// One run from samples to triangles, plane by plane, so that samples are in the cache when vertices are made
// of them. Vertices are numbered from 0.
class March {
 public:
  March(const Frame& frame, const CellMasks& masks, const CaseLookup& cases, const ExtractOptions& options,
        const Run& run, Surface& into, std::uint64_t* row_first, std::vector<PartRun>* part_runs)
      : frame_(frame),
        masks_(masks),
        cases_(cases),
        options_(options),
        run_(run),
        into_(into),
        row_first_(row_first),
        part_runs_(part_runs),
        signs_(frame),
        before_(frame),
        active_(frame),
        edges_(frame),
        next_edges_(frame) {
    into.positions.resize_uninitialised(0);
    into.normals.resize_uninitialised(0);
    into.keys.resize_uninitialised(0);
    into.triangles.resize_uninitialised(0);
  }

  // The loops of the centre vertices, which are not made: the last ones hang on vertices of the next run.
  std::vector<CentreLoop> run() {
    for (std::int64_t p = run_.first - 1; p <= run_.first + 1; ++p) scan(p);
    find_active(frame_, masks_, signs_, run_.first - 1, active_);
    // One plane more than the run has, since triangles name vertices of the plane after theirs.
    for (std::int64_t p = run_.first; p <= std::min(run_.last, frame_.cell_planes); ++p) {
      if (p < run_.last) scan(p + 2);
      const std::uint64_t vertices = find(p);
      if (p > run_.first) write_triangle_plane();
      if (p < run_.last) write_vertex_plane(vertices);
    }
    return std::move(centres_);
  }

 private:
  void scan(std::int64_t p) {
    if (p >= 0 && p < frame_.sample_planes) signs_.scan(frame_, masks_, p);
  }

  // What plane p has, in numbers and bits. Returns the vertices.
  std::uint64_t find(std::int64_t p) {
    std::swap(before_, active_);
    std::swap(edges_, next_edges_);
    std::swap(slow_, next_slow_);
    triangles_ = next_triangles_;
    find_active(frame_, masks_, signs_, p, active_);
    std::uint64_t vertices = find_edges(frame_, signs_, p, before_, active_, next_edges_);
    next_slow_.clear();
    next_triangles_ = count_triangles(frame_, signs_, cases_, p, active_, next_slow_);
    vertices += count_centres(next_slow_, next_edges_);
    const std::uint64_t first = into_.positions.size();
    if (first + vertices > std::numeric_limits<std::uint32_t>::max()) refuse_vertices();
    number_vertices(frame_, first, next_edges_);
    return vertices;
  }

  void write_vertex_plane(std::uint64_t count) {
    const std::size_t first = into_.positions.size();
    into_.positions.grow(first + count);
    if (options_.normals) into_.normals.grow(first + count);
    if (options_.keys) into_.keys.grow(first + count);
    list_vertices(frame_, next_edges_, next_slow_, list_);
    write_vertices(frame_, next_edges_.p, list_, into_.positions.data() + first,
                   options_.normals ? into_.normals.data() + first : nullptr,
                   options_.keys ? into_.keys.data() + first : nullptr);
  }

  // Of the plane before the one found last.
  void write_triangle_plane() {
    const std::size_t first = into_.triangles.size();
    into_.triangles.grow(first + triangles_);
    write_triangles(frame_, cases_, before_, edges_, next_edges_, slow_, first,
                    into_.triangles.all().subspan(first), row_first_ + edges_.p * frame_.cell_rows, centres_);
    if (part_runs_ != nullptr) list_part_runs(frame_, cases_, before_, edges_.p, slow_, first, *part_runs_);
  }

  const Frame& frame_;
  const CellMasks& masks_;
  const CaseLookup& cases_;
  const ExtractOptions& options_;
  Run run_;
  Surface& into_;
  std::uint64_t* row_first_;
  std::vector<PartRun>* part_runs_;
  BitPlanes signs_;
  ActiveCells before_;
  ActiveCells active_;
  PlaneMasks edges_;
  PlaneMasks next_edges_;
  std::vector<SlowCell> slow_;
  std::vector<SlowCell> next_slow_;
  std::uint64_t triangles_ = 0;
  std::uint64_t next_triangles_ = 0;
  VertexList list_;
  std::vector<CentreLoop> centres_;
};

// What a run gave, and where it goes in the whole.
struct Part {
  Surface surface;  // not of the first run, whose is the whole's beginning
  std::vector<CentreLoop> centres;
  std::vector<PartRun> part_runs;
  std::uint64_t first_vertex = 0;
  std::uint64_t first_triangle = 0;
};

// Slice n of `slices` of what a part has.
template <class T>
void copy_slice(const PageVector<T>& from, std::uint64_t first, std::size_t n, std::size_t slices,
                PageVector<T>& into) {
  if (into.empty()) return;  // not asked for
  const std::size_t begin = from.size() * n / slices;
  std::copy(from.data() + begin, from.data() + from.size() * (n + 1) / slices, into.data() + first + begin);
}

void copy_triangles(const Part& part, std::size_t n, std::size_t slices, Surface& into) {
  const std::size_t begin = part.surface.triangles.size() * n / slices;
  const std::size_t end = part.surface.triangles.size() * (n + 1) / slices;
  const Triangle* const from = part.surface.triangles.data();
  Triangle* const to = into.triangles.data() + part.first_triangle;
  const auto by = static_cast<std::uint32_t>(part.first_vertex);
  for (std::size_t t = begin; t < end; ++t) to[t] = {from[t][0] + by, from[t][1] + by, from[t][2] + by};
}

// Puts the parts of all runs behind that of the first one.
void join(const Frame& frame, const std::vector<Run>& runs, const ExtractOptions& options,
          std::vector<Part>& parts, Surface& into) {
  std::uint64_t vertices = into.positions.size();
  std::uint64_t triangles = into.triangles.size();
  for (std::size_t run = 1; run < runs.size(); ++run) {
    parts[run].first_vertex = vertices;
    parts[run].first_triangle = triangles;
    vertices += parts[run].surface.positions.size();
    triangles += parts[run].surface.triangles.size();
  }
  if (vertices > std::numeric_limits<std::uint32_t>::max()) refuse_vertices();
  into.positions.grow(vertices);
  if (options.normals) into.normals.grow(vertices);
  if (options.keys) into.keys.grow(vertices);
  into.triangles.grow(triangles);
  into.row_first.back() = triangles;

  const auto slices = static_cast<std::size_t>(options.threads);
  for (std::size_t run = 1; run < runs.size(); ++run) {
    Part& part = parts[run];
    for_each_in_parallel(options.threads, options.threads, [&](std::int64_t slice, int) {
      const auto n = static_cast<std::size_t>(slice);
      copy_slice(part.surface.positions, part.first_vertex, n, slices, into.positions);
      copy_slice(part.surface.normals, part.first_vertex, n, slices, into.normals);
      copy_slice(part.surface.keys, part.first_vertex, n, slices, into.keys);
      copy_triangles(part, n, slices, into);
    });
    part.surface = {};
    const std::int64_t last = std::min(runs[run].last, frame.cell_planes) * frame.cell_rows;
    for (std::int64_t row = runs[run].first * frame.cell_rows; row < last; ++row) {
      into.row_first[static_cast<std::size_t>(row)] += part.first_triangle;
    }
  }
  for (Part& part : parts) {
    for (CentreLoop& centre : part.centres) {
      centre.vertex += static_cast<std::uint32_t>(part.first_vertex);
      for (std::uint32_t& vertex : centre.around) vertex += static_cast<std::uint32_t>(part.first_vertex);
    }
    write_centres(part.centres, into.positions.data(), options.normals ? into.normals.data() : nullptr);
  }
}

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
  if (options.part_runs != nullptr) options.part_runs->clear();
  if (into.cells.empty()) {
    make_empty(into);
    return;
  }
  const Frame frame(field, isovalue, into.cells);
  const CellMasks masks(frame, options.bricks, options.parts);
  const CaseLookup cases;
  const std::vector<Run> runs = runs_of(frame, masks, options.threads);
  std::vector<Part> parts(runs.size());
  into.row_first.resize(static_cast<std::size_t>(frame.cell_planes * frame.cell_rows) + 1);
  for_each_in_parallel(static_cast<std::int64_t>(runs.size()), options.threads, [&](std::int64_t n, int) {
    const auto run = static_cast<std::size_t>(n);
    Surface& made = run == 0 ? into : parts[run].surface;
    std::vector<PartRun>* const listed = options.part_runs != nullptr ? &parts[run].part_runs : nullptr;
    parts[run].centres =
        March(frame, masks, cases, options, runs[run], made, into.row_first.data(), listed).run();
  });
  join(frame, runs, options, parts, into);
  if (options.part_runs == nullptr) return;
  for (const Part& part : parts) {
    for (PartRun run : part.part_runs) {
      run.first_triangle += part.first_triangle;
      options.part_runs->push_back(run);
    }
  }
}

}  // namespace footwall::isosurface
