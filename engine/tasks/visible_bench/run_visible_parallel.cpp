#include <fmt/format.h>
#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/visible/paper/visible_paper.h"
#include "engine/isosurface/visible/parallel/brick_pillars.h"
#include "engine/isosurface/visible/parallel/world_ranks.h"
#include "engine/isosurface/visible/visible_drawing.h"
#include "engine/render/composite/compose.h"
#include "engine/tasks/visible_bench/visible_bench.h"
#include "storage/base/partial_file.h"
#include "storage/formats/raw.h"

namespace footwall::tasks {
namespace {

using namespace isosurface;
using Json = nlohmann::ordered_json;

constexpr render::Rgba kColour = render::hex(0xd9a066);
// x of the picture is the file's fastest axis, our samples; z is its slowest one.
constexpr render::Placement kPlacement{{0, 0, 1, 0, 1, 0, 1, 0, 0}, {}};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The whole surface, extracted and drawn by one rank.
struct Whole {
  std::int64_t triangles = 0;
  std::int64_t triangles_seen = 0;  // that own a pixel
  double extract_seconds = 0;
  double draw_seconds = 0;
  std::vector<float> depth;

  std::int64_t pixels() const {
    return std::count_if(depth.begin(), depth.end(), [](float d) { return d < 1; });
  }
};

struct Run {
  double seconds = 0;
  VisibleReport report;
  std::vector<VisiblePieces::Busy> busy_seconds;  // mode paper
};

class Bench {
 public:
  Bench(const comm::Communicator& parent, const VisibleBench& bench, const JobContext& job)
      : world_(parent.get()), bench_(bench), job_(job) {
    world_.collectively([&] {
      if (bench.mode != "paper" && bench.mode != "depth") {
        throw Error(ErrorCode::kUsage, fmt::format("there is no mode '{}'", bench.mode),
                    "use depth or paper");
      }
      const formats::raw::RawFile file(bench.raw, bench.size);
      values_.resize_uninitialised(static_cast<std::size_t>(bench.size[0] * bench.size[1] * bench.size[2]));
      file.read_block({{0, 0, 0}, bench.size}, values_.all());
      volume_ = {values_.all(), bench.size, {0, 0, 0}, bench.size};
      ranges_ = brick_ranges(volume_, bench.threads);
      cell_ = bench.cell;
      const survey::Index chosen = default_paper_cell(bench.size);
      for (int axis = 0; axis < 3; ++axis) cell_[axis] = cell_[axis] == 0 ? chosen[axis] : cell_[axis];
      if (is_depth()) {
        parts_.emplace(volume_, world_.size(), world_.rank(), Interleaving{1, 1, 1});
        return;
      }
      if (world_.rank() == 0) octree_ = paper_octree(volume_, ranges_.tables(), cell_, bench.threads);
    });
  }

  Json all() {
    Json whole = Json::array();
    Json rows = Json::array();
    for (std::size_t view = 0; view < bench_.views.size(); ++view) {
      world_.collectively([&] {
        job_.report(static_cast<double>(view) / static_cast<double>(bench_.views.size()), "passes",
                    fmt::format("{} of {} views", view, bench_.views.size()));
      });
      const VisibleRequest request = world_.collectively([&] { return request_of(bench_.views[view]); });
      const Whole drawn =
          world_.collectively([&] { return world_.rank() == 0 ? whole_of(request) : Whole(); });
      whole.push_back({{"view", view},
                       {"triangles", drawn.triangles},
                       {"pixels", drawn.pixels()},
                       {"triangles_seen", drawn.triangles_seen},
                       {"extract_seconds", drawn.extract_seconds},
                       {"draw_seconds", drawn.draw_seconds}});
      // Mode depth counts the work.
      if (is_depth()) rows.push_back(row_of(view, request, {0, 0, 0}, drawn));
      if (is_depth()) continue;
      for (const survey::Index& estimate : bench_.estimate_cells)
        rows.push_back(row_of(view, request, estimate, drawn));
    }
    Json views = Json::array();
    for (const VisibleView& view : bench_.views) views.push_back({view.azimuth, view.elevation});
    return {{"ranks", world_.size()},    {"threads", bench_.threads},
            {"size", bench_.size},       {"value", bench_.value},
            {"mode", bench_.mode},       {"views", std::move(views)},
            {"width", bench_.width},     {"perspective", bench_.perspective},
            {"height", bench_.height},   {"cell", is_depth() ? kBrickCells : cell_},
            {"repeats", bench_.repeats}, {"whole", std::move(whole)},
            {"rows", std::move(rows)}};
  }

 private:
  VisibleRequest request_of(const VisibleView& view) const;
  Whole whole_of(const VisibleRequest& request) const;
  Json row_of(std::size_t view, VisibleRequest request, const survey::Index& estimate, const Whole& whole);
  bool is_depth() const { return bench_.mode == "depth"; }
  // One picture's triangles, from the isovalue on, without what the last picture told.
  Run passes_of(const VisibleRequest& request);
  render::SurfaceLayer picture_of(const VisibleRequest& request);
  // Of this rank, in the last picture.
  std::int64_t own_triangles();
  // Over all passes.
  double load_difference_of_all();
  // Draws what was found. On rank 0 adds to the row how the picture differs from that of the whole surface.
  void compare(const VisibleRequest& request, const Whole& whole, Json& row);

  comm::Communicator world_;
  const VisibleBench& bench_;
  const JobContext& job_;
  PageVector<float> values_;
  Field volume_;
  BrickRanges ranges_;
  survey::Index cell_{0, 0, 0};
  std::optional<Octree> octree_;  // mode paper, on rank 0
  VisiblePieces pieces_;
  std::optional<BrickPillars> parts_;  // mode depth
  VisibleDrawing drawing_;
  render::Composer composer_;
};

VisibleRequest Bench::request_of(const VisibleView& view) const {
  std::vector<render::Vec3> corners;
  for (unsigned n = 0; n < 8; ++n) {
    const auto at = [&](unsigned axis) {
      return (n >> axis & 1U) != 0 ? static_cast<double>(bench_.size[axis] - 1) : 0.0;
    };
    corners.push_back(kPlacement({at(0), at(1), at(2)}));
  }
  VisibleRequest request;
  request.isovalue = bench_.value;
  request.volume_size = bench_.size;
  request.bricks = ranges_.tables();
  request.placement = kPlacement;
  request.camera =
      render::Camera::look(view.azimuth, view.elevation, 1, corners,
                           static_cast<double>(bench_.width) / bench_.height, bench_.perspective);
  request.colour = kColour;
  request.width = bench_.width;
  request.height = bench_.height;
  request.mode = is_depth() ? VisibleMode::kDepth : VisibleMode::kPaper;
  request.threads = bench_.threads;
  request.cell = cell_;
  return request;
}

Whole Bench::whole_of(const VisibleRequest& request) const {
  Whole whole;
  std::vector<double> extracts;
  std::vector<double> draws;
  render::SurfaceFrame frame;
  render::VisibilityBuffer window(request.width, request.height);
  SomeTriangles all;
  // The first one pays for new memory.
  for (int n = 0; n <= bench_.repeats; ++n) {
    ExtractOptions options;
    options.threads = request.threads;
    options.bricks = &request.bricks;
    const double start = omp_get_wtime();
    extract(volume_, request.isovalue, options, all.surface);
    const double extracted = omp_get_wtime();
    all.runs = {{0, 0}};
    const render::LitSurface surface = lit(all, kColour, kPlacement);
    window.clear();
    frame.project(std::span(&surface, 1), request.camera, request.width, request.height, request.threads);
    if (!surface.triangles.empty()) frame.rasterize(window, request.threads);
    if (n > 0) extracts.push_back(extracted - start);
    if (n > 0) draws.push_back(omp_get_wtime() - extracted);
    whole.triangles = static_cast<std::int64_t>(surface.triangles.size());
  }
  std::set<render::PrimitiveId> seen;
  for (const render::Visible pixel : window.pixels()) {
    whole.depth.push_back(render::depth_of(pixel));
    if (pixel != render::kBackground) seen.insert(render::primitive_of(pixel));
  }
  whole.triangles_seen = static_cast<std::int64_t>(seen.size());
  whole.extract_seconds = median(std::move(extracts));
  whole.draw_seconds = median(std::move(draws));
  return whole;
}

Run Bench::passes_of(const VisibleRequest& request) {
  Run run;
  drawing_.forget();
  comm::check(MPI_Barrier(world_.get()), "MPI_Barrier");
  const double start = omp_get_wtime();
  if (is_depth()) {
    WorldRanks ranks(world_, job_);
    run.report = drawing_.draw(ranks, parts_->parts(), request);
  } else {
    extract_visible_paper(world_, volume_, octree_ ? &*octree_ : nullptr, request, job_.part(1, 1), {},
                          pieces_);
    run.report = pieces_.report;
    run.busy_seconds = pieces_.busy_seconds;
  }
  run.seconds = world_.maximum(omp_get_wtime() - start);
  return run;
}

render::SurfaceLayer Bench::picture_of(const VisibleRequest& request) {
  const render::ComposeOptions options{request.width, request.height, request.threads, {}};
  render::ComposeReport report;
  if (is_depth())
    return composer_.compose_drawn(world_, drawing_.frame(), drawing_.window(), options, report);
  std::vector<render::LitSurface> surfaces;
  for (const SomeTriangles& some : pieces_.passes)
    surfaces.push_back(lit(some, request.colour, request.placement));
  return composer_.compose(world_, surfaces, request.camera, options, report);
}

std::int64_t Bench::own_triangles() {
  if (is_depth()) return static_cast<std::int64_t>(drawing_.frame().triangles());
  std::int64_t triangles = 0;
  for (const SomeTriangles& some : pieces_.passes)
    triangles += static_cast<std::int64_t>(some.surface.triangles.size());
  return triangles;
}

void Bench::compare(const VisibleRequest& request, const Whole& whole, Json& row) {
  const double start = omp_get_wtime();
  const render::SurfaceLayer layer = picture_of(request);
  row["draw_seconds"] = world_.maximum(omp_get_wtime() - start);
  world_.collectively([&] {
    if (world_.rank() != 0) return;
    std::int64_t covered = 0;
    std::int64_t farther = 0;
    std::int64_t lost = 0;
    const auto width = static_cast<std::size_t>(request.width);
    std::vector<float> depths(width);
    std::vector<render::Rgba> colours(width);
    for (int y = 0; y < request.height; ++y) {
      layer.row(y, depths, colours);
      for (std::size_t x = 0; x < width; ++x) {
        const float want = whole.depth[static_cast<std::size_t>(y) * width + x];
        if (depths[x] < want) {
          throw Error(ErrorCode::kInternal, fmt::format("pixel {}, {} shows what is not there", x, y));
        }
        covered += depths[x] < 1 ? 1 : 0;
        farther += depths[x] < 1 && depths[x] > want ? 1 : 0;
        lost += depths[x] == 1 && want < 1 ? 1 : 0;
      }
    }
    row["pixels"] = covered;
    row["pixels_farther"] = farther;
    row["pixels_lost"] = lost;
  });
}

double Bench::load_difference_of_all() {
  const std::int64_t triangles = own_triangles();
  std::vector<std::int64_t> of_ranks(static_cast<std::size_t>(world_.size()));
  comm::check(MPI_Allgather(&triangles, 1, MPI_INT64_T, of_ranks.data(), 1, MPI_INT64_T, world_.get()),
              "MPI_Allgather");
  return load_difference(of_ranks, of_ranks);
}

Json Bench::row_of(std::size_t view, VisibleRequest request, const survey::Index& estimate,
                   const Whole& whole) {
  request.estimate_cell = estimate;
  Json row{{"view", view}, {"estimate_cell", estimate}};
  // The first one, which pays for new memory, is drawn.
  passes_of(request);
  row["load_difference"] = load_difference_of_all();
  compare(request, whole, row);
  std::vector<Run> runs;
  for (int n = 0; n < bench_.repeats; ++n) runs.push_back(passes_of(request));
  if (world_.rank() != 0) return row;
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.seconds < b.seconds; });
  const Run& middle = runs[runs.size() / 2];
  Json seconds = Json::array();
  for (const Run& run : runs) seconds.push_back(run.seconds);
  Json passes = Json::array();
  double busy = 0;
  for (std::size_t n = 0; n < middle.report.passes.size(); ++n) {
    const VisiblePass& pass = middle.report.passes[n];
    const VisiblePass::Seconds& s = pass.seconds;
    Json busy_of_pass;
    if (n < middle.busy_seconds.size()) {
      const auto& [host, extract] = middle.busy_seconds[n];
      busy += host + extract;
      busy_of_pass = {{"host", host}, {"extract", extract}};
    }
    passes.push_back({{"cells", pass.cells},
                      {"triangles", pass.triangles},
                      {"load_difference", pass.load_difference},
                      {"uncovered_pixels", pass.uncovered_pixels},
                      {"percent", pass.percent},
                      {"seconds",
                       {{"visibility", s.visibility},
                        {"partition", s.partition},
                        {"assign", s.assign},
                        {"extract", s.extract},
                        {"composite", s.composite}}},
                      {"busy_seconds", std::move(busy_of_pass)}});
  }
  row["triangles"] = middle.report.triangles;
  row["finished"] = middle.report.finished;
  row["median_seconds"] = middle.seconds;
  row["busy_seconds"] = is_depth() ? Json() : Json(busy);
  row["seconds"] = std::move(seconds);
  row["passes"] = std::move(passes);
  return row;
}

}  // namespace

void run_visible_bench(const comm::Communicator& parent, const std::filesystem::path& job_path,
                       const JobContext& job) {
  const VisibleBench bench = parent.collectively([&] { return read_visible_bench(job_path); });
  const Json json = Bench(parent, bench, job).all();
  parent.collectively([&] {
    if (parent.rank() == 0) write_whole_file(bench.result, json.dump(1) + "\n");
  });
}

}  // namespace footwall::tasks
