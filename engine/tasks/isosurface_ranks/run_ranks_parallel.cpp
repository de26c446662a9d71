#include <fmt/format.h>
#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/canonical.h"
#include "engine/isosurface/parallel/choose_pillars.h"
#include "engine/isosurface/parallel/collect.h"
#include "engine/isosurface/parallel/extract_parallel.h"
#include "engine/isosurface/parallel/weld.h"
#include "engine/isosurface/registry.h"
#include "engine/tasks/isosurface_ranks/ranks_run.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

using namespace isosurface;
using Json = nlohmann::ordered_json;

std::vector<float> read_raw(const RanksRun& run) {
  std::error_code failure;
  const auto count = static_cast<std::size_t>(run.size[0] * run.size[1] * run.size[2]);
  const auto bytes = std::filesystem::file_size(run.raw, failure);
  if (failure) throw Error(ErrorCode::kNotFound, fmt::format("there is no volume {}", run.raw.string()));
  if (bytes != count * sizeof(float)) {
    throw Error(ErrorCode::kFormat,
                fmt::format("{} has {} bytes, expected {}", run.raw.string(), bytes, count * sizeof(float)));
  }
  std::vector<float> values(count);
  std::ifstream file(run.raw, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(bytes)))
    throw Error(ErrorCode::kIo, fmt::format("cannot read {}", run.raw.string()));
  return values;
}

// The samples of a rank's pillars, each pillar's on their own.
class Held {
 public:
  Held(const Field& whole, const Pillars& pillars, int rank, bool normals) : whole_(whole) {
    for (const survey::Box& cells : pillars.of_rank(rank)) {
      const survey::Box box = pillars.samples_of(cells, normals);
      std::vector<float> values;
      values.reserve(static_cast<std::size_t>(box.count()));
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          const float* const row = whole.values.data() + (i * whole.size[1] + j) * whole.size[2];
          values.insert(values.end(), row + box.lo[2], row + box.hi[2]);
        }
      }
      parts_.emplace_back(box, std::move(values));
    }
  }
  // The pillar around the box.
  Field of(const survey::Box& wanted) const {
    for (const auto& [box, values] : parts_) {
      if (intersection(box, wanted) == wanted)
        return {values, {box.size(0), box.size(1), box.size(2)}, box.lo, whole_.volume_size};
    }
    throw Error(ErrorCode::kInternal, "no pillar holds the samples");
  }

 private:
  const Field& whole_;
  std::vector<std::pair<survey::Box, std::vector<float>>> parts_;
};

class Bench {
 public:
  Bench(const comm::Communicator& parent, const RanksRun& run, const JobContext& job)
      : world_(parent.get()), run_(run), job_(job) {
    world_.collectively([&] {
      variant_ = &variant_of(run.variant);
      values_ = read_raw(run);
      whole_ = {values_, run.size, {0, 0, 0}, run.size};
      ranges_ = brick_ranges(whole_, run.threads);
      bricks_ = ranges_.tables();
      ExtractOptions options;
      options.normals = run.normals;
      options.keys = true;
      options.threads = run.threads;
      if (world_.rank() == 0) variant_->extract(whole_, run.value, options, expected_);
    });
  }

  Json all() {
    Json rows = Json::array();
    for (std::size_t n = 0; n < run_.interleavings.size(); ++n) {
      world_.collectively([&] {
        job_.report(static_cast<double>(n) / static_cast<double>(run_.interleavings.size()), "extract",
                    fmt::format("{} of {} ways", n, run_.interleavings.size()));
      });
      rows.push_back(row_of(run_.interleavings[n]));
    }
    const Interleaving chosen =
        choose_interleaving(run_.size, world_.size(), bricks_, run_.value, run_.normals);
    return {{"ranks", world_.size()},
            {"threads", run_.threads},
            {"repeats", run_.repeats},
            {"triangles", expected_.triangles.size()},
            {"vertices", expected_.positions.size()},
            {"chosen", text_of(chosen)},
            {"rows", std::move(rows)}};
  }

 private:
  Json row_of(const Interleaving& interleaving);
  // Throws on all ranks unless the pieces make up the surface of the whole volume. Returns the vertices that
  // were computed more than once.
  std::int64_t check(const Pillars& pillars, const FieldOf& field_of, ParallelOptions options);

  comm::Communicator world_;
  const RanksRun& run_;
  const JobContext& job_;
  const Variant* variant_ = nullptr;
  std::vector<float> values_;
  Field whole_;
  BrickRanges ranges_;
  Bricks bricks_;
  Surface expected_;  // on rank 0
};

std::int64_t Bench::check(const Pillars& pillars, const FieldOf& field_of, ParallelOptions options) {
  options.keys = true;
  Extraction extraction;
  extract_parallel(world_, pillars, field_of, run_.value, options, job_.part(1, 1), extraction);
  MeshPart part = weld(world_, pillars, run_.normals, extraction.pieces);
  const std::int64_t computed = world_.sum(static_cast<std::int64_t>(part.computed));
  const auto own = [&](const auto& values) { return values.all().first(values.empty() ? 0 : part.own); };
  const Bounds vertices = all_on_first(part.all_vertices, world_.size());
  const Surface& mesh = part.mesh;
  Surface found;
  found.positions = collect<Point>(world_, part.vertex_runs, own(mesh.positions), vertices);
  found.keys = collect<VertexKey>(world_, part.vertex_runs, own(mesh.keys), vertices);
  if (run_.normals) found.normals = collect<Point>(world_, part.vertex_runs, own(mesh.normals), vertices);
  for (Triangle& triangle : part.mesh.triangles.all())
    triangle = {part.numbers[triangle[0]], part.numbers[triangle[1]], part.numbers[triangle[2]]};
  found.triangles = collect<Triangle>(world_, part.triangle_runs, mesh.triangles.all(),
                                      all_on_first(part.all_triangles, world_.size()));
  world_.collectively([&] {
    if (world_.rank() != 0) return;
    const auto where = difference(found, expected_, run_.size);
    if (!where) return;
    throw Error(ErrorCode::kInternal,
                fmt::format("pillars {} give another surface: {}", text_of(pillars.interleaving()), *where));
  });
  return computed - static_cast<std::int64_t>(part.all_vertices);
}

Json Bench::row_of(const Interleaving& interleaving) {
  const Pillars pillars(run_.size, world_.size(), interleaving);
  const Held held = world_.collectively([&] { return Held(whole_, pillars, world_.rank(), run_.normals); });
  const FieldOf field_of = [&](const survey::Box& box) { return held.of(box); };
  ParallelOptions options;
  options.kernel = variant_->extract;
  options.normals = run_.normals;
  options.threads = run_.threads;
  if (run_.pyramid) options.bricks = &bricks_;
  options.kernel_skips = variant_ == variants().data();
  const std::int64_t redundant = check(pillars, field_of, options);

  double best_max = std::numeric_limits<double>::infinity();
  double best_mean = 0;
  double best_wall = 0;
  Extraction extraction;
  for (int n = 0; n < run_.repeats; ++n) {
    comm::check(MPI_Barrier(world_.get()), "MPI_Barrier");
    const double start = omp_get_wtime();
    extract_parallel(world_, pillars, field_of, run_.value, options, job_.part(1, 1), extraction);
    const double wall = world_.maximum(omp_get_wtime() - start);
    const double most = world_.maximum(extraction.busy_seconds);
    double mean = extraction.busy_seconds / world_.size();
    comm::check(MPI_Allreduce(MPI_IN_PLACE, &mean, 1, MPI_DOUBLE, MPI_SUM, world_.get()), "MPI_Allreduce");
    if (most >= best_max) continue;
    best_max = most;
    best_mean = mean;
    best_wall = wall;
  }
  return {{"pillars", text_of(interleaving)},
          {"mean_seconds", best_mean},
          {"max_seconds", best_max},
          {"load_imbalance", best_max > 0 ? 1 - best_mean / best_max : 0},
          {"wall_seconds", best_wall},
          {"redundant_intersections", redundant},
          {"overlap_samples", pillars.overlap_samples(run_.normals)}};
}

}  // namespace

void run_ranks(const comm::Communicator& parent, const RanksRun& run, const std::filesystem::path& result,
               const JobContext& job) {
  Bench bench(parent, run, job);
  const Json json = bench.all();
  parent.collectively([&] {
    if (parent.rank() == 0) write_whole_file(result, json.dump(1) + "\n");
  });
}

}  // namespace footwall::tasks
