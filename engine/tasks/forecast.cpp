#include "engine/tasks/forecast.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <numeric>

#include "engine/comm/rank_grid.h"
#include "engine/extract/choice.h"
#include "engine/extract/computations.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/extract.h"
#include "engine/extract/fold_rows.h"
#include "engine/extract/probes.h"
#include "engine/session/launcher.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"
#include "storage/volume/chunk_grid.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {
namespace {

// Recorded with two ranks on two cores (docs/batch-jobs.md); everything else is measured or counted.
constexpr double kStartSeconds = 0.3;  // the launcher, MPI_Init, the job, the volume's table of hashes
constexpr double kStartSecondsOfRank = 0.05;
constexpr double kWriteSecondsOfFace = 2e-6;   // with reading the faces, and gathering the results
constexpr double kWriteSecondsOfPart = 12e-3;  // two flushes to the disk
constexpr std::int64_t kProgramBytes = std::int64_t{32} << 20;
constexpr std::int64_t kRecordBytes = 80;  // of a face's partial sums on their way
constexpr std::int64_t kVoxelBytes = 16;   // of a voxel that is asked for and sent

constexpr std::int64_t kMostCounted = 2'000'000;              // faces
constexpr std::int64_t kPieceVoxels = std::int64_t{8} << 20;  // of the volume that is tried
constexpr double kTrialSeconds = 0.4;

class Counter final : public voxelize::RowSink {
 public:
  void row(const voxelize::Row& row) override { voxels_ += voxelize::voxels_in(row); }
  std::int64_t take() { return std::exchange(voxels_, 0); }

 private:
  std::int64_t voxels_ = 0;
};

survey::Index centroid_voxel(const survey::LatticeTriangle& t, const survey::Index& dims) {
  const auto clamped = [](std::int64_t sum, std::int64_t count) {
    // Good to half a voxel, which is enough for a forecast.
    return std::clamp<std::int64_t>(sum / (3 * survey::kLatticePerVoxel), 0, count - 1);
  };
  return {clamped(std::int64_t{t[0].i} + t[1].i + t[2].i, dims[0]),
          clamped(std::int64_t{t[0].j} + t[1].j + t[2].j, dims[1]),
          clamped(std::int64_t{t[0].k} + t[1].k + t[2].k, dims[2])};
}

void count_voxels(const session::Job& job, const comm::RankGrid& grid, const JobContext& context,
                  Forecast& out) {
  const auto voxelizer = voxelize::make_voxelizer(job.options.voxelizer);
  const survey::Box all = job.geometry.box();
  Counter counter;
  const std::int64_t step = std::max<std::int64_t>(1, (out.faces + kMostCounted - 1) / kMostCounted);
  std::vector<std::int64_t> of_rank(static_cast<std::size_t>(grid.ranks()));
  std::int64_t number = 0;
  std::int64_t looked_at = 0;
  std::int64_t counted = 0;
  for (const session::JobFault& fault : job.faults) {
    for (const extract::Face& face : fault.faces) {
      if (number++ % step != 0) continue;
      if (looked_at % 4096 == 0)
        context.report(static_cast<double>(number) / static_cast<double>(out.faces), "count", fault.name);
      voxelizer->rows(face.triangle, all, counter);
      const std::int64_t voxels = counter.take();
      ++looked_at;
      counted += voxels;
      of_rank[static_cast<std::size_t>(grid.owner(centroid_voxel(face.triangle, grid.dims())))] += voxels;
    }
  }
  out.voxels_exact = step == 1;
  out.voxels = out.voxels_exact || looked_at == 0
                   ? counted
                   : static_cast<std::int64_t>(static_cast<double>(counted) / static_cast<double>(looked_at) *
                                               static_cast<double>(out.faces));
  if (counted > 0) {
    out.load_max_over_mean = static_cast<double>(*std::max_element(of_rank.begin(), of_rank.end())) *
                             grid.ranks() / static_cast<double>(counted);
  }
}

// Calls visit(slab) for each box that a rank reads at once.
template <typename Visit>
void each_slab(const survey::Box& wanted, Visit&& visit) {
  if (wanted.empty()) return;
  for (std::int64_t i = wanted.lo[0] / extract::kSlabInlines * extract::kSlabInlines; i < wanted.hi[0];
       i += extract::kSlabInlines) {
    survey::Box slab = wanted;
    slab.lo[0] = std::max(slab.lo[0], i);
    slab.hi[0] = std::min(slab.hi[0], i + extract::kSlabInlines);
    visit(slab);
  }
}

survey::Box with_halo(const survey::Box& own, const survey::Index& dims) {
  if (own.empty()) return {};
  return survey::intersection(
      {{own.lo[0] - 1, own.lo[1] - 1, own.lo[2]}, {own.hi[0] + 1, own.hi[1] + 1, own.hi[2]}},
      {{0, 0, 0}, dims});
}

std::int64_t bytes_of(const volume::ChunkGrid& chunks, const survey::Box& box) {
  return chunks.touched_by(box).count() * chunks.voxels() * static_cast<std::int64_t>(sizeof(float));
}

void sum_bytes(const session::Job& job, const comm::RankGrid& grid, const volume::ChunkGrid& chunks,
               Forecast& out) {
  constexpr auto kFloat = static_cast<std::int64_t>(sizeof(float));
  Forecast::Memory& memory = out.memory;
  for (int rank = 0; rank < grid.ranks(); ++rank) {
    std::int64_t bricks = 0;
    for (const survey::Box& own : grid.boxes(rank)) {
      bricks += (own.size(0) + 2) * (own.size(1) + 2) * own.size(2) * kFloat;
      each_slab(with_halo(own, grid.dims()), [&](const survey::Box& slab) {
        out.bytes_to_read += bytes_of(chunks, slab);
        // The slab itself, and the chunks that it is cut from.
        memory.reading = std::max(memory.reading, slab.count() * kFloat + bytes_of(chunks, slab));
      });
    }
    memory.bricks = std::max(memory.bricks, bricks);
  }
  memory.program = kProgramBytes;
  // The file's bytes, the faces of every fault, and those of the group that is being computed.
  memory.mesh = out.faces * 3 * static_cast<std::int64_t>(sizeof(extract::Face));
  // A group of faults at a time (session/batch.h).
  std::int64_t group = std::max<std::int64_t>(20000, out.faces / 20);
  for (const session::JobFault& fault : job.faults)
    group = std::max(group, static_cast<std::int64_t>(fault.faces.size()));
  group = std::min(group, out.faces);
  const extract::Choice exchange = extract::parse_choice(job.options.exchange);
  const bool voxels_move = exchange.name != "auto" && extract::exchange_strategy(exchange.name).moves_voxels;
  const std::int64_t sent = (voxels_move ? out.voxels * kVoxelBytes : group * kRecordBytes) / out.ranks;
  // At one rank nothing moves; else what is kept of others' voxels grows to its limit at most.
  const std::int64_t kept =
      voxels_move && out.ranks > 1 ? std::min(job.options.cache_bytes, out.voxels * kFloat) : 0;
  memory.exchange =
      2 * sent + kept + (out.faces + group) * static_cast<std::int64_t>(sizeof(extract::FaceStatistics));
}

struct Rates {
  double bytes = 0;   // read per second
  double voxels = 0;  // folded per second and thread; 0 where no face lies in the piece
};

// Reads the columns around the middle face, and folds the faces in them.
Rates measured(const session::Job& job, const volume::VolumeReader& reader, const volume::ChunkGrid& chunks,
               const JobContext& context) {
  const survey::Index& dims = reader.info().dims;
  const session::JobFault& fault = job.faults[job.faults.size() / 2];
  const survey::Index middle = fault.faces.empty()
                                   ? survey::Index{dims[0] / 2, dims[1] / 2, 0}
                                   : centroid_voxel(fault.faces[fault.faces.size() / 2].triangle, dims);
  const auto half = static_cast<std::int64_t>(
      std::sqrt(static_cast<double>(kPieceVoxels) / static_cast<double>(dims[2])) / 2);
  const survey::Box piece = survey::intersection(
      {{middle[0] - half, middle[1] - half, 0}, {middle[0] + half + 1, middle[1] + half + 1, dims[2]}},
      {{0, 0, 0}, dims});
  double start = omp_get_wtime();
  extract::Block block(piece, dims);
  const survey::Box wanted = block.wanted();
  std::vector<float> values(static_cast<std::size_t>(wanted.count()));
  reader.read(wanted, values);
  block.put(wanted, values);
  Rates rates;
  rates.bytes = static_cast<double>(bytes_of(chunks, wanted)) / (omp_get_wtime() - start);

  const auto voxelizer = voxelize::make_voxelizer(job.options.voxelizer);
  const std::size_t probes = extract::probe_shifts(job.options).size();
  const bool discontinuity = extract::asks_for(job.options, "discontinuity") || probes > 0;
  extract::RowFolder folder(
      block, discontinuity,
      discontinuity ? extract::discontinuity_scale(reader.info().statistics.max_abs) : 0);
  std::int64_t voxels = 0;
  std::int64_t counts = 0;
  std::vector<std::byte> record;
  start = omp_get_wtime();
  double spent = 0;
  for (int round = 0; spent < kTrialSeconds / 4 && round < 64; ++round) {
    const std::int64_t before = voxels;
    for (const session::JobFault& each : job.faults) {
      for (const extract::Face& face : each.faces) {
        if (survey::intersection(voxelize::bounding_voxels(face.triangle), piece).empty()) continue;
        voxelizer->rows(face.triangle, piece, folder);
        const extract::Partial partial = folder.take();
        // As it would go to another rank and end there.
        record.clear();
        extract::encode(0, partial, record);
        counts += extract::finish(partial, true).count;
        voxels += partial.voxels();
        spent = omp_get_wtime() - start;
        if (spent > kTrialSeconds) break;
      }
      context.check();
      if (spent > kTrialSeconds) break;
    }
    spent = omp_get_wtime() - start;
    if (voxels == before) break;  // no face lies here
  }
  require(counts <= voxels, "no more values than voxels");
  // A probe costs what its face does, and the faces of whole faults are walked once more.
  if (voxels > 0) rates.voxels = static_cast<double>(voxels) / spent / static_cast<double>(2 + probes);
  return rates;
}

}  // namespace

Forecast forecast(const session::Job& job, const session::LaunchOptions& launch,
                  const std::filesystem::path& job_path, int cores, const JobContext& context) {
  Forecast out;
  out.ranks = launch.ranks > 0 ? launch.ranks : session::default_ranks();
  out.threads = job.options.threads;
  out.command = session::launch_command(launch, job_path);
  out.launcher = session::choose_launcher(out.ranks, out.threads, {}).why;
  for (const session::JobFault& fault : job.faults)
    out.faces += static_cast<std::int64_t>(fault.faces.size());

  const volume::VolumeReader reader(job.volume);
  const volume::ChunkGrid chunks{reader.info().dims, reader.info().chunk};
  const comm::RankGrid grid(reader.info().dims, out.ranks, job.options.pillars);
  count_voxels(job, grid, context.part(0, 0.7), out);
  sum_bytes(job, grid, chunks, out);
  const Rates rates = measured(job, reader, chunks, context.part(0.7, 1));

  // Ranks that share processors take turns; the rank with the most voxels ends last.
  const int workers = out.ranks * out.threads;
  const double at_once = cores > 0 ? std::min(workers, cores) : workers;
  const double readers = std::min<double>(out.ranks, at_once);
  out.seconds.start = kStartSeconds + kStartSecondsOfRank * out.ranks;
  out.seconds.read = static_cast<double>(out.bytes_to_read) / (rates.bytes * readers);
  if (rates.voxels > 0) {
    const double alone = static_cast<double>(out.voxels) * out.load_max_over_mean / workers / rates.voxels;
    const double shared = static_cast<double>(out.voxels) / at_once / rates.voxels;
    out.seconds.compute = std::max(alone, shared);
  }
  out.seconds.write = kWriteSecondsOfFace * static_cast<double>(out.faces) +
                      kWriteSecondsOfPart * static_cast<double>(job.faults.size()) / out.ranks;
  out.based_on = fmt::format(
      "reading a piece of the volume here just now ({:.0f} MB/s) and folding the faces in it ({}), times {} "
      "ranks "
      "of {} threads on {:.0f} cores; starting and writing as recorded on two cores",
      rates.bytes / 1e6,
      rates.voxels > 0 ? fmt::format("{:.0f} million voxels/s a thread", rates.voxels / 1e6)
                       : "none lies there, so computing is left out",
      out.ranks, out.threads, at_once);
  return out;
}

}  // namespace footwall::tasks
