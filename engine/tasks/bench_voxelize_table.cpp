#include "engine/tasks/bench_voxelize_table.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <utility>

#include "engine/tasks/detail/voxelize_published.h"
#include "engine/voxelize/registry.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {
namespace {

using survey::IndexPoint;
using survey::LatticeTriangle;

constexpr int kTriangles = 512;  // 2^9 signs
constexpr int kMostRuns = 10000;
constexpr int kMostThreads = 1024;
constexpr double kLargestArea = 1e12;
constexpr std::int64_t kComparedVoxels = 200000;  // of each row with `exact`
constexpr VertexTriple kSampleRun = {{{15, 12, 5}, {10, 5, 2}, {4, 3, 6}}};

LatticeTriangle on_lattice(const VertexTriple& vertices) {
  static const survey::Lattice lattice{survey::Geometry{}};
  return {lattice.from_index(vertices[0]), lattice.from_index(vertices[1]), lattice.from_index(vertices[2])};
}

double area_of(const LatticeTriangle& t) {
  const auto edge = [&](std::size_t n) {
    constexpr double kVoxel = survey::kLatticePerVoxel;
    return std::array<double, 3>{(static_cast<double>(t[n].i) - t[0].i) / kVoxel,
                                 (static_cast<double>(t[n].j) - t[0].j) / kVoxel,
                                 (static_cast<double>(t[n].k) - t[0].k) / kVoxel};
  };
  const auto a = edge(1);
  const auto b = edge(2);
  const double x = a[1] * b[2] - a[2] * b[1];
  const double y = a[2] * b[0] - a[0] * b[2];
  const double z = a[0] * b[1] - a[1] * b[0];
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

class CountingSink final : public voxelize::RowSink {
 public:
  void row(const voxelize::Row& row) override { voxels += voxelize::voxels_in(row); }
  std::int64_t voxels = 0;
};

struct Worker {
  std::unique_ptr<voxelize::Voxelizer> voxelizer;
  std::vector<voxelize::Voxel> list;
  std::int64_t voxels = 0;
};

void voxelize_one(const LatticeTriangle& triangle, VoxelOutput output, Worker& worker) {
  if (output == VoxelOutput::kCoordinates) {
    worker.voxelizer->visits(triangle, kAllVoxels, worker.list);
    worker.voxels += static_cast<std::int64_t>(worker.list.size());
  } else {
    CountingSink sink;
    worker.voxelizer->rows(triangle, kAllVoxels, sink);
    worker.voxels += sink.voxels;
  }
}

std::int64_t voxelize_all(const std::vector<LatticeTriangle>& triangles, VoxelOutput output,
                          std::vector<Worker>& workers, const JobContext& job) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  const int team = static_cast<int>(workers.size());
#pragma omp parallel for num_threads(team) schedule(static, 1) if (team > 1)
  for (int thread = 0; thread < team; ++thread) {
    Worker& worker = workers[static_cast<std::size_t>(thread)];
    worker.voxels = 0;
    try {
      for (std::size_t n = next++; n < triangles.size(); n = next++) {
        job.check();
        voxelize_one(triangles[n], output, worker);
      }
    } catch (...) {
#pragma omp critical(footwall_bench_voxelize)
      failure = std::current_exception();
      next = triangles.size();
    }
  }
  if (failure) std::rethrow_exception(failure);
  std::int64_t voxels = 0;
  for (const Worker& worker : workers) voxels += worker.voxels;
  return voxels;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Of this process so far.
struct Clocks {
  double wall = 0;
  double user = 0;
  double system = 0;
};

Clocks clocks() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(now).count(), seconds_of(usage.ru_utime), seconds_of(usage.ru_stime)};
}

void time_row(const VoxelizeTableOptions& options, const std::vector<LatticeTriangle>& triangles,
              VoxelizeTableRow& row, const JobContext& job) {
  const bool inside = voxelize::method_of(options.voxelizer).threads_inside;
  std::vector<Worker> workers(inside ? 1 : static_cast<std::size_t>(row.threads));
  for (Worker& worker : workers)
    worker.voxelizer = voxelize::make_voxelizer(options.voxelizer, inside ? row.threads : 1);
  row.voxels = voxelize_all(triangles, options.output, workers, job);  // also warms caches and buffers
  const Clocks start = clocks();
  for (int run = 0; run < options.runs; ++run) {
    job.report(static_cast<double>(run) / options.runs, "voxelize",
               fmt::format("area {:.6g}, {} threads, run {} of {}", row.mean_area, row.threads, run + 1,
                           options.runs));
    if (voxelize_all(triangles, options.output, workers, job) != row.voxels)
      throw Error(ErrorCode::kInternal, "two runs found different numbers of voxels");
  }
  const Clocks end = clocks();
  row.wall = (end.wall - start.wall) / options.runs;
  row.user = (end.user - start.user) / options.runs;
  row.system = (end.system - start.system) / options.runs;
}

void add(const VoxelizerCheck& check, VoxelizerCheck& sum) {
  sum.triangles += check.triangles;
  sum.cubes += check.cubes;
}

void add(const VoxelDifferences& found, VoxelDifferences& sum) {
  sum.triangles += found.triangles;
  sum.exact += found.exact;
  sum.missed += found.missed;
  sum.extra += found.extra;
  sum.repeated += found.repeated;
}

void check_options(const VoxelizeTableOptions& options) {
  if (options.runs < 1 || options.runs > kMostRuns) {
    throw Error(ErrorCode::kUsage, fmt::format("{} runs; 1 to {} are possible", options.runs, kMostRuns));
  }
  for (const int threads : options.threads) {
    if (threads < 1 || threads > kMostThreads)
      throw Error(ErrorCode::kUsage, fmt::format("{} threads; 1 to {} are possible", threads, kMostThreads));
  }
  for (const double area : options.areas) {
    if (!(area >= 1 && area <= kLargestArea))
      throw Error(ErrorCode::kUsage,
                  fmt::format("a mean area of {} voxel^2; 1 to {} are possible", area, kLargestArea));
  }
}

}  // namespace

IndexPoint parse_vertex(const std::string& text) {
  const auto fields = text::split(text, ',');
  IndexPoint point;
  double* const into[] = {&point.i, &point.j, &point.k};
  bool good = fields.size() == 3;
  for (std::size_t n = 0; good && n < 3; ++n) {
    const auto number = text::number(fields[n]);
    good = number.has_value();
    if (good) *into[n] = *number;
  }
  if (!good) {
    throw Error(ErrorCode::kUsage, fmt::format("'{}' is not a vertex", text),
                "a vertex is x,y,z in voxels, e.g. 15,12,5");
  }
  return point;
}

std::vector<LatticeTriangle> sign_triangles(const VertexTriple& vertices, bool one_triangle) {
  std::vector<LatticeTriangle> triangles;
  triangles.reserve(kTriangles);
  for (int signs = 0; signs < kTriangles; ++signs) {
    VertexTriple signed_vertices = vertices;
    int bit = 0;
    for (IndexPoint& p : signed_vertices) {
      for (double* x : {&p.i, &p.j, &p.k}) {
        if (!one_triangle && ((signs >> bit) & 1) != 0) *x = -*x;
        ++bit;
      }
    }
    triangles.push_back(on_lattice(signed_vertices));
  }
  return triangles;
}

VertexTriple triple_of_mean_area(double area, bool one_triangle) {
  double sum = 0;
  for (const LatticeTriangle& triangle : sign_triangles(kSampleRun, one_triangle)) sum += area_of(triangle);
  const double scale = std::sqrt(area / (sum / kTriangles));
  VertexTriple triple = kSampleRun;
  for (IndexPoint& p : triple) p = {p.i * scale, p.j * scale, p.k * scale};
  return triple;
}

VoxelizeTable bench_voxelize_table(const VoxelizeTableOptions& options, const JobContext& job) {
  check_options(options);
  VoxelizeTable table;
  table.voxelizer = options.voxelizer;
  table.simd = voxelize::simd_in_use();
  table.output = options.output;
  table.runs = options.runs;
  table.triangles = kTriangles;
  const bool exact = voxelize::method_of(options.voxelizer).exact;

  std::vector<std::pair<double, VertexTriple>> triples;
  if (options.vertices) {
    triples.emplace_back(0, *options.vertices);
  } else {
    std::vector<double> areas = options.areas;
    if (areas.empty()) areas.assign(kPublishedAreas.begin(), kPublishedAreas.end());
    for (const double area : areas)
      triples.emplace_back(area, triple_of_mean_area(area, options.one_triangle));
  }
  const double rows = static_cast<double>(triples.size() * options.threads.size());
  double done = 0;
  for (const auto& [asked, vertices] : triples) {
    const std::vector<LatticeTriangle> triangles = sign_triangles(vertices, options.one_triangle);
    job.report(done / rows, "check");
    add(check_voxelizer(options.voxelizer, triangles, job), table.check);
    if (!exact) {
      const std::span<const LatticeTriangle> compared(triangles.data(),
                                                      options.one_triangle ? 1 : triangles.size());
      add(differences_from_exact(options.voxelizer, compared, kComparedVoxels, job), table.differences);
    }
    VoxelizeTableRow row;
    row.asked_area = asked;
    row.vertices = vertices;
    row.min_area = row.max_area = area_of(triangles.front());
    for (const LatticeTriangle& triangle : triangles) {
      const double area = area_of(triangle);
      row.mean_area += area / kTriangles;
      row.min_area = std::min(row.min_area, area);
      row.max_area = std::max(row.max_area, area);
    }
    for (const int threads : options.threads) {
      row.threads = threads;
      time_row(options, triangles, row, job.part(done / rows, (done + 1) / rows));
      table.rows.push_back(row);
      ++done;
    }
  }
  job.report(1, "done");
  return table;
}

}  // namespace footwall::tasks
