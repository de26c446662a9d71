// Owners fold their own voxels into exact partial sums; these, not voxels, go to the responsible ranks.
// Every rank knows the faces and the boxes of all ranks: a face's bounding box says who may have sums of it,
// so that messages go between those pairs of ranks alone, and no size is asked for. Where a rank is
// responsible for what only it folds (always, on one rank), the sums become statistics on the spot.
// Steps: 1 deal: who folds and who sends what; 2 voxelize: every rank walks the part that lies in its own
// columns of the faces of others; 3 exchange: one round of records begins; 4 voxelize: the faces that it is
// responsible for, meanwhile; 5 exchange: the records end; 6 compute: merges and finishes those.
#include "engine/extract/exchange/phases.h"
#include "engine/extract/exchange/reduce_buffers.h"
#include "engine/extract/parallel_faces.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"

namespace footwall::extract {
namespace {

using Task = ReduceBuffers::Task;

// Fewer faces than this need so little memory that its lack may end the job without agreement.
constexpr std::size_t kFewFaces = 4096;
// Between two looks at the messages under way.
constexpr std::size_t kFacesPerLook = 64;

// Calls visit(rank) once for each rank with columns in the box, which lies in the survey and is not empty.
template <typename Visit>
void each_owner(const comm::RankGrid& grid, const survey::Box& box, Visit&& visit) {
  const auto [rows, columns] = grid.lines();
  const auto [rows_of_ranks, columns_of_ranks] = grid.parts();
  const std::int64_t first_row = box.lo[0] / rows;
  const std::int64_t first_column = box.lo[1] / columns;
  const std::int64_t row_count =
      std::min<std::int64_t>((box.hi[0] - 1) / rows - first_row + 1, rows_of_ranks);
  const std::int64_t column_count =
      std::min<std::int64_t>((box.hi[1] - 1) / columns - first_column + 1, columns_of_ranks);
  for (std::int64_t a = 0; a < row_count; ++a) {
    for (std::int64_t b = 0; b < column_count; ++b) {
      visit(static_cast<int>((first_row + a) % rows_of_ranks * columns_of_ranks +
                             (first_column + b) % columns_of_ranks));
    }
  }
}

ReduceBuffers::Partner& partner(ReduceBuffers& kept, int rank) {
  std::int32_t& number = kept.partner_of_rank[static_cast<std::size_t>(rank)];
  if (number < 0) {
    number = static_cast<std::int32_t>(kept.partners.size());
    kept.partners.push_back({rank});
  }
  return kept.partners[static_cast<std::size_t>(number)];
}

// Step 1: the tasks of this rank, the most records for each pair, and room for what comes.
void deal(const Setup& setup, ReduceBuffers& kept, std::vector<Finished>& finished) {
  const int me = setup.world.rank();
  const std::size_t faces = setup.input.faces.size();
  const survey::Box survey{{0, 0, 0}, setup.grid.dims()};
  kept.make_workers(setup);
  kept.to_send.clear();
  kept.tasks.clear();
  kept.partners.clear();
  kept.partner_of_rank.assign(static_cast<std::size_t>(setup.world.size()), -1);
  kept.task_of_face.assign(setup.world.size() > 1 ? faces : 0, -1);
  std::int32_t shared = 0;
  kept.order.of(setup.input.faces);
  for (std::size_t at = 0; at < faces; ++at) {
    if (at % kFewFaces == kFewFaces - 1)
      setup.job.check();  // never in the few that are dealt without agreement
    const std::size_t n = kept.order[at];
    const survey::Box box = survey::intersection(voxelize::bounding_voxels(setup.face(n).triangle), survey);
    const bool mine = setup.mine(n);
    bool own = false;
    bool others = false;
    if (!box.empty()) {
      each_owner(setup.grid, box, [&](int rank) {
        own = own || rank == me;
        if (!mine || rank == me) return;
        others = true;
        ++partner(kept, rank).from;
      });
    }
    if (!mine && !own) continue;
    Task task{static_cast<std::int64_t>(n)};
    task.own_voxels = own;
    if (mine) {
      task.slot = static_cast<std::int64_t>(finished.size());
      finished.push_back({task.face, {}});
      if (others) {
        task.shared = shared++;
        kept.task_of_face[n] = static_cast<std::int64_t>(kept.tasks.size());
      }
    } else {
      ++partner(kept, setup.responsible[n]).to;
      task.partner = kept.partner_of_rank[static_cast<std::size_t>(setup.responsible[n])];
    }
    (mine ? kept.tasks : kept.to_send).push_back(task);
  }
  kept.partials.assign(static_cast<std::size_t>(shared), {});
  const std::size_t most = most_bytes(setup.with_discontinuity);
  if (kept.rooms.size() < kept.partners.size()) kept.rooms.resize(kept.partners.size());
  kept.incoming.clear();
  kept.outgoing.clear();
  kept.outgoing.reserve(kept.partners.size());
  for (ReduceBuffers::Worker& worker : kept.workers) {
    worker.walked = 0;
    if (worker.records.size() < kept.partners.size()) worker.records.resize(kept.partners.size());
    for (std::vector<std::byte>& records : worker.records) records.clear();
  }
  for (std::size_t p = 0; p < kept.partners.size(); ++p) {
    const ReduceBuffers::Partner& from = kept.partners[p];
    if (from.from == 0) continue;
    kept.incoming.push_back({from.rank, kept.rooms[p].of(from.from * most)});
  }
}

// Steps 2 and 4: the own part of some faces.
void fold(const Setup& setup, std::span<const Task> tasks, ReduceBuffers& kept,
          std::vector<Finished>& finished) {
  setup.job.check();  // also where there is no face
  const std::span<const Block> blocks = setup.blocks.all();
  const int threads = static_cast<int>(
      std::min<std::size_t>(static_cast<std::size_t>(setup.threads), std::max<std::size_t>(1, tasks.size())));
  parallel_faces(tasks.size(), threads, setup.job, "voxelize", [&](std::size_t thread, std::size_t n) {
    if (thread == 0 && n % kFacesPerLook == 0) setup.world.progress_known();
    const Task& task = tasks[n];
    const survey::LatticeTriangle& triangle = setup.face(static_cast<std::size_t>(task.face)).triangle;
    ReduceBuffers::Worker& worker = kept.workers[thread];
    Partial partial;
    if (task.own_voxels) {
      const survey::Box around = voxelize::bounding_voxels(triangle);
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (survey::intersection(around, blocks[b].own()).empty()) continue;
        worker.voxelizer->rows(triangle, blocks[b].own(), *worker.folders[b]);
        partial.merge(worker.folders[b]->take());
      }
      worker.walked += partial.voxels();
    }
    if (task.partner >= 0) {
      if (partial.voxels() > 0)
        encode(task.face, partial, worker.records[static_cast<std::size_t>(task.partner)]);
    } else if (task.shared >= 0) {
      kept.partials[static_cast<std::size_t>(task.shared)] = partial;
    } else {
      finished[static_cast<std::size_t>(task.slot)].statistics =
          finish(partial, inside(triangle, setup.input.dims));
    }
  });
}

// The records for each partner, one thread's behind the other's.
void put_together(ReduceBuffers& kept) {
  ReduceBuffers::Worker& first = kept.workers.front();
  for (std::size_t p = 0; p < kept.partners.size(); ++p) {
    for (std::size_t w = 1; w < kept.workers.size(); ++w) {
      const std::vector<std::byte>& more = kept.workers[w].records[p];
      first.records[p].insert(first.records[p].end(), more.begin(), more.end());
    }
  }
}

// Step 3. A rank that failed sends empty messages, so that nobody waits.
void begin_messages(const Setup& setup, ReduceBuffers& kept, bool failed) {
  const std::size_t most = most_bytes(setup.with_discontinuity);
  for (std::size_t p = 0; p < kept.partners.size(); ++p) {
    const ReduceBuffers::Partner& to = kept.partners[p];
    if (to.to == 0) continue;
    std::span<const std::byte> bytes;
    if (!failed) bytes = kept.workers.front().records[p];
    kept.outgoing.push_back({to.rank, bytes, to.to * most});
  }
  setup.world.begin_known(kept.outgoing, kept.incoming);
}

// Step 6.
void merge_all(const Setup& setup, ReduceBuffers& kept, std::vector<Finished>& finished) {
  for (const comm::KnownIncoming& message : kept.incoming) {
    std::span<const std::byte> rest = message.room.first(message.received);
    while (!rest.empty()) {
      Partial part;
      const auto face = static_cast<std::size_t>(decode(rest, part));
      require(face < kept.task_of_face.size() && kept.task_of_face[face] >= 0,
              "partial sums of a face of this rank");
      const Task& task = kept.tasks[static_cast<std::size_t>(kept.task_of_face[face])];
      kept.partials[static_cast<std::size_t>(task.shared)].merge(part);
    }
  }
  for (const Task& task : kept.tasks) {
    if (task.shared < 0) continue;
    finished[static_cast<std::size_t>(task.slot)].statistics =
        finish(kept.partials[static_cast<std::size_t>(task.shared)],
               inside(setup.face(static_cast<std::size_t>(task.face)).triangle, setup.input.dims));
  }
}

}  // namespace

void ReduceBuffers::make_workers(const Setup& setup) {
  const bool same = voxelizer_ == setup.options.voxelizer && scale_ == setup.scale &&
                    with_discontinuity_ == setup.with_discontinuity &&
                    workers.size() == static_cast<std::size_t>(setup.threads);
  if (same) return;
  workers.clear();
  for (int n = 0; n < setup.threads; ++n) {
    Worker worker;
    worker.voxelizer = voxelize::make_voxelizer(setup.options.voxelizer);
    for (const Block& block : setup.blocks.all())
      worker.folders.push_back(std::make_unique<RowFolder>(block, setup.with_discontinuity, setup.scale));
    workers.push_back(std::move(worker));
  }
  voxelizer_ = setup.options.voxelizer;
  scale_ = setup.scale;
  with_discontinuity_ = setup.with_discontinuity;
}

Kept::Kept() = default;
Kept::~Kept() = default;

Outcome exchange_reduce(const Setup& setup) {
  Outcome outcome;
  Phases phases(setup);
  if (!setup.kept.reduce) setup.kept.reduce = std::make_unique<ReduceBuffers>();
  ReduceBuffers& kept = *setup.kept.reduce;
  const auto dealt = [&] { deal(setup, kept, outcome.finished); };
  if (setup.input.faces.size() < kFewFaces) {
    dealt();
  } else {
    setup.world.collectively(dealt);
  }
  const auto unless_failed = [&](auto&& step) {
    if (outcome.failure) return;
    try {
      step();
    } catch (...) {
      outcome.failure = comm::current_error();
    }
  };
  unless_failed([&] {
    fold(setup, kept.to_send, kept, outcome.finished);
    put_together(kept);
  });
  phases.enter(&Seconds::exchange);
  begin_messages(setup, kept, outcome.failure.has_value());
  phases.enter(&Seconds::voxelize);
  unless_failed([&] { fold(setup, kept.tasks, kept, outcome.finished); });
  phases.enter(&Seconds::exchange);
  phases.meet();
  setup.world.end_known(kept.incoming);
  phases.meet();
  phases.enter(&Seconds::compute);
  unless_failed([&] { merge_all(setup, kept, outcome.finished); });
  for (const ReduceBuffers::Worker& worker : kept.workers) outcome.walked += worker.walked;
  if (outcome.failure) kept.workers.clear();  // they hold half a face
  outcome.seconds = phases.end();
  return outcome;
}

}  // namespace footwall::extract
