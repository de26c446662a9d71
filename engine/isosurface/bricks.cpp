#include "engine/isosurface/bricks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <vector>

#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/detail/march.h"
#include "engine/isosurface/detail/threads.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

using namespace detail;

constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();
// One on each edge and a centre.
constexpr std::uint64_t kMostVerticesOfCell = 13;

[[noreturn]] void refuse_vertices() {
  throw Error(ErrorCode::kUnsupported, "the isosurface would have more than 2^32 - 1 vertices",
              "take a part of the volume, or more ranks");
}

// Hands out room for the results of runs, in their order: vertices and triangles get their numbers, and so
// their places, as soon as the runs before are counted, while those are still being written.
class Order {
 public:
  Order(const ExtractOptions& options, Surface& into) : options_(options), into_(into) {
    into.positions.resize_uninitialised(0);
    into.normals.resize_uninitialised(0);
    into.keys.resize_uninitialised(0);
    into.triangles.resize_uninitialised(0);
  }

  // Whether results of up to so many vertices and triangles can be written by many threads: their room must
  // not move then. It is but addresses, given back by finish() where nothing was written.
  bool reserve(std::uint64_t vertices, std::uint64_t triangles) {
    return into_.positions.reserve(vertices) && (!options_.normals || into_.normals.reserve(vertices)) &&
           (!options_.keys || into_.keys.reserve(vertices)) && into_.triangles.reserve(triangles);
  }

  // Waits until all runs before `run` have been counted. None where another thread has given up.
  std::optional<Place> place(std::int64_t run, const Count& count) {
    for (std::int64_t turn = turn_; turn != run; turn = turn_) {
      if (turn == kGivenUp) return std::nullopt;
      turn_.wait(turn);
    }
    Place place;
    place.vertex = into_.positions.size();
    place.triangle = into_.triangles.size();
    const std::uint64_t vertices = place.vertex + count.vertices;
    if (vertices > kMostVertices) refuse_vertices();
    into_.positions.grow(vertices);
    if (options_.normals) into_.normals.grow(vertices);
    if (options_.keys) into_.keys.grow(vertices);
    into_.triangles.grow(place.triangle + count.triangles);
    place.positions = into_.positions.data() + place.vertex;
    if (options_.normals) place.normals = into_.normals.data() + place.vertex;
    if (options_.keys) place.keys = into_.keys.data() + place.vertex;
    place.triangles = into_.triangles.data() + place.triangle;
    std::int64_t expected = run;  // not so where another thread has given up meanwhile
    turn_.compare_exchange_strong(expected, run + 1);
    turn_.notify_all();
    return place;
  }

  // Has the system make the pages that the next runs will need, if they have about as much as this one: two
  // threads that come to a new page at once would both wait for it to be cleared.
  void prepare(const Place& place, const Count& count) {
    const std::uint64_t vertices = place.vertex + kRunsAhead * count.vertices;
    make_pages(into_.positions, 0, vertices);
    if (options_.normals) make_pages(into_.normals, 1, vertices);
    make_pages(into_.triangles, 2, place.triangle + kRunsAhead * count.triangles);
  }
  void give_up() {
    turn_ = kGivenUp;
    turn_.notify_all();
  }

  void finish() {
    into_.positions.trim();
    into_.normals.trim();
    into_.keys.trim();
    into_.triangles.trim();
    into_.row_first.back() = into_.triangles.size();
  }

 private:
  static constexpr std::int64_t kGivenUp = -1;
  static constexpr std::uint64_t kRunsAhead = 2;

  template <class T>
  void make_pages(PageVector<T>& array, std::size_t which, std::uint64_t size) {
    const std::size_t pages = std::min(size * sizeof(T) / kHugePage + 1, array.room_bytes() / kHugePage);
    for (std::size_t page = made_[which]; page < pages;) {
      if (made_[which].compare_exchange_weak(page, page + 1)) array.make_page(page++);
    }
  }

  const ExtractOptions& options_;
  Surface& into_;
  std::atomic<std::int64_t> turn_ = 0;
  std::array<std::atomic<std::size_t>, 3> made_{};  // huge pages
};

// Planes that a thread takes at a time: few, so that their samples stay near, but each run looks at three
// planes of its neighbours, too.
constexpr std::int64_t kPlanesOfRun = 12;

// The last ones are smaller, so that all threads end together.
std::vector<Run> runs_of(const Frame& frame, std::int64_t most_planes, int threads) {
  constexpr std::int64_t kFewest = 3;
  std::vector<Run> runs;
  for (std::int64_t first = 0; first < frame.sample_planes; first = runs.back().last) {
    const std::int64_t left = frame.sample_planes - first;
    const std::int64_t planes = std::min(std::max(left / (2 * threads), kFewest), most_planes);
    runs.push_back({first, std::min(first + planes, frame.sample_planes)});
  }
  return runs;
}

void make_empty(Surface& into) {
  into.positions.resize_uninitialised(0);
  into.normals.resize_uninitialised(0);
  into.triangles.resize_uninitialised(0);
  into.keys.resize_uninitialised(0);
  into.row_first.assign(static_cast<std::size_t>(into.cells.size(0) * into.cells.size(1)) + 1, 0);
}

void gather_part_runs(const std::vector<Besides>& besides, std::vector<PartRun>& into) {
  for (const Besides& made : besides) {
    into.insert(into.end(), made.part_runs.begin(), made.part_runs.end());
  }
  std::sort(into.begin(), into.end(),
            [](const PartRun& a, const PartRun& b) { return a.first_triangle < b.first_triangle; });
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
  into.row_first.resize(static_cast<std::size_t>(frame.cell_planes * frame.cell_rows) + 1);
  Order order(options, into);
  const std::uint64_t cells = masks.cells();
  const auto most_vertices = std::min(kMostVertices, kMostVerticesOfCell * cells);
  // Without room that stays in its place one thread goes on alone.
  const bool stays = order.reserve(most_vertices, kMostTrianglesOfCell * cells);
  const bool many = options.threads > 1 && stays && cells > 0;
  const int threads = many ? options.threads : 1;
  const std::int64_t most_planes = many ? kPlanesOfRun : 1;
  const std::vector<Run> runs = runs_of(frame, most_planes, threads);
  std::vector<Besides> besides(static_cast<std::size_t>(threads));
  std::atomic<std::size_t> next = 0;
  for_each_in_parallel(threads, threads, [&](std::int64_t n, int) {
    try {
      Besides& mine = besides[static_cast<std::size_t>(n)];
      March march(frame, masks, cases, most_planes, into.row_first.data(), mine);
      for (std::size_t run = next++; run < runs.size(); run = next++) {
        const Count count = march.find(runs[run]);
        const std::optional<Place> place = order.place(static_cast<std::int64_t>(run), count);
        if (!place) return;
        if (many) order.prepare(*place, count);
        march.write(*place);
        if (options.part_runs != nullptr) march.list_parts(*place);
      }
    } catch (...) {
      order.give_up();
      throw;
    }
  });
  order.finish();
  for (const Besides& made : besides) {
    write_centres(made.centres, into.positions.data(), options.normals ? into.normals.data() : nullptr);
  }
  if (options.part_runs != nullptr) gather_part_runs(besides, *options.part_runs);
}

}  // namespace footwall::isosurface
