#include "engine/extract/extract.h"

#include <omp.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>

#include "engine/extract/auto_choice.h"
#include "engine/extract/balance/balance.h"
#include "engine/extract/computations.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/registry.h"
#include "engine/extract/statistics/discontinuity.h"
#include "engine/voxelize/registry.h"
#include "engine/voxelize/simd.h"
#include "storage/base/hash.h"
#include "storage/base/log.h"

namespace footwall::extract {
namespace {

// Reads wanted() in slabs of whole chunks of inlines; every rank makes the same number of calls. A rank that
// has no such block takes part with an empty box.
void read_block(const comm::Communicator& world, const ReadBox& read, const JobContext& job, Block* block) {
  const survey::Box wanted = block == nullptr ? survey::Box{} : block->wanted();
  const std::int64_t first = wanted.empty() ? 0 : wanted.lo[0] / kSlabInlines;
  const std::int64_t last = wanted.empty() ? 0 : (wanted.hi[0] + kSlabInlines - 1) / kSlabInlines;
  const std::int64_t rounds = world.maximum(last - first);
  std::vector<float> values;
  for (std::int64_t round = 0; round < rounds; ++round) {
    survey::Box slab = wanted;
    slab.lo[0] = std::max(wanted.lo[0], (first + round) * kSlabInlines);
    slab.hi[0] = std::min(wanted.hi[0], (first + round + 1) * kSlabInlines);
    if (slab.empty()) slab = {};
    world.collectively([&] {
      job.report(static_cast<double>(round) / static_cast<double>(rounds), "read",
                 std::to_string(round) + " of " + std::to_string(rounds) + " slabs");
      values.resize(static_cast<std::size_t>(slab.count()));
    });
    world.collectively([&] { read(slab, values); });  // throws on all ranks or on none, as promised
    if (block != nullptr) block->put(slab, values);
  }
}

void read_blocks(const comm::Communicator& world, const ReadBox& read, const JobContext& job,
                 Blocks& blocks) {
  const std::span<Block> own = blocks.all();
  const auto most = static_cast<std::size_t>(world.maximum(static_cast<std::int64_t>(own.size())));
  for (std::size_t n = 0; n < most; ++n) {
    const double share = 1 / static_cast<double>(most);
    const JobContext part = job.part(static_cast<double>(n) * share, static_cast<double>(n + 1) * share);
    read_block(world, read, part, n < own.size() ? &own[n] : nullptr);
  }
}

// The results of all ranks at rank 0, in the order of the input.
std::vector<FaceStatistics> gathered(comm::Communicator& world, const std::vector<Finished>& mine,
                                     std::size_t faces) {
  static_assert(std::is_trivially_copyable_v<Finished>);
  const std::vector<comm::Bytes> parts = world.exchange(world.collectively([&] {
    std::vector<comm::Bytes> outgoing(static_cast<std::size_t>(world.size()));
    const auto raw = std::as_bytes(std::span(mine));
    outgoing[0].assign(raw.begin(), raw.end());
    return outgoing;
  }));
  return world.collectively([&] {
    std::vector<FaceStatistics> all;
    if (world.rank() != 0) return all;
    all.resize(faces);
    std::size_t seen = 0;
    for (const comm::Bytes& part : parts) {
      for (std::size_t at = 0; at < part.size(); at += sizeof(Finished), ++seen) {
        Finished finished;
        std::memcpy(&finished, part.data() + at, sizeof finished);
        all.at(static_cast<std::size_t>(finished.face)) = finished.statistics;
      }
    }
    require(seen == faces, "one result for every face");
    return all;
  });
}

// The whole-face results of all ranks at rank 0, one for each computation.
std::vector<FaceBlobs> gathered_blobs(comm::Communicator& world, std::vector<FinishedBlob> mine,
                                      std::span<const Computation* const> computations, std::size_t faces) {
  struct Head {
    std::int64_t face, computation, bytes;
  };
  const std::vector<comm::Bytes> parts = world.exchange(world.collectively([&] {
    std::vector<comm::Bytes> outgoing(static_cast<std::size_t>(world.size()));
    for (FinishedBlob& blob : mine) {
      const Head head{blob.face, static_cast<std::int64_t>(blob.computation),
                      static_cast<std::int64_t>(blob.bytes.size())};
      const auto raw = std::as_bytes(std::span(&head, 1));
      outgoing[0].insert(outgoing[0].end(), raw.begin(), raw.end());
      outgoing[0].insert(outgoing[0].end(), blob.bytes.begin(), blob.bytes.end());
      blob.bytes = {};
    }
    return outgoing;
  }));
  return world.collectively([&] {
    std::vector<FaceBlobs> all;
    if (world.rank() != 0) return all;
    std::vector<std::vector<std::span<const std::byte>>> of(computations.size(),
                                                            std::vector<std::span<const std::byte>>(faces));
    for (const comm::Bytes& part : parts) {
      for (std::size_t at = 0; at < part.size();) {
        Head head{};
        std::memcpy(&head, part.data() + at, sizeof head);
        at += sizeof head;
        of.at(static_cast<std::size_t>(head.computation)).at(static_cast<std::size_t>(head.face)) =
            std::span(part).subspan(at, static_cast<std::size_t>(head.bytes));
        at += static_cast<std::size_t>(head.bytes);
      }
    }
    for (std::size_t c = 0; c < computations.size(); ++c) {
      FaceBlobs& blobs = all.emplace_back();
      blobs.computation = computations[c]->name;
      blobs.offsets.push_back(0);
      for (const std::span<const std::byte> bytes : of[c]) {
        blobs.bytes.insert(blobs.bytes.end(), bytes.begin(), bytes.end());
        blobs.offsets.push_back(blobs.bytes.size());
      }
    }
    return all;
  });
}

template <typename T>
void append(T value, std::vector<std::byte>& bytes) {
  static_assert(std::endian::native == std::endian::little);
  const auto raw = std::as_bytes(std::span(&value, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

double canonical(double value) {
  return std::isnan(value) ? kUndefined : value;
}

}  // namespace

bool inside(const survey::LatticeTriangle& triangle, const survey::Index& dims) {
  constexpr std::int64_t kHalf = survey::kLatticePerVoxel / 2;
  return std::all_of(triangle.begin(), triangle.end(), [&](const survey::LatticePoint& p) {
    const survey::Index at{p.i, p.j, p.k};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < -kHalf || at[axis] > (dims[axis] - 1) * survey::kLatticePerVoxel + kHalf) return false;
    }
    return true;
  });
}

void validate(const Options& options) {
  const Choice exchange = parse_choice(options.exchange);
  const Choice balance = parse_choice(options.balance);
  find_row(exchange_rows(), "exchange", exchange.name);
  exchange_strategy(exchange.name).check(exchange);
  find_row(balance_rows(), "balance", balance.name);
  balance_strategy(balance.name).check(balance);
  for (const std::string& name : options.compute) computation(name);
  find_row(voxelizer_rows(), "voxelizer", options.voxelizer);
  voxelize::make_voxelizer(options.voxelizer);
  const std::vector<const Computation*> whole = whole_face_computations(options);
  if (!whole.empty() && exchange.name != "auto" && !exchange_strategy(exchange.name).moves_voxels) {
    throw Error(ErrorCode::kUsage,
                "'" + std::string(whole.front()->name) + "' needs the voxels of a face, and exchange '" +
                    exchange.name + "' moves none",
                "use --exchange push");
  }
  for (const Computation* each : whole) each->make(options);
  if (options.threads < 1 || options.threads > 1024) {
    throw Error(ErrorCode::kUsage, "there cannot be " + std::to_string(options.threads) + " threads",
                "give 1 to 1024 threads for each rank");
  }
}

struct LoadedSurvey::State {
  State(const comm::Communicator& parent, const comm::RankGrid& its_grid)
      : grid(its_grid),
        world(parent, grid),
        blocks(world.collectively([&] { return Blocks(grid, world.rank()); })) {
    world.collectively([&] {
      cache = std::make_unique<VoxelCache>(grid, blocks);
      sent = std::make_unique<SentRecord>(grid, world.rank());
    });
  }
  void forget_cache() {
    cache->clear();
    sent->clear();
  }
  comm::RankGrid grid;
  comm::Communicator world;
  Blocks blocks;
  AutoChoice automatic;
  std::unique_ptr<VoxelCache> cache;
  std::unique_ptr<SentRecord> sent;
  bool told_of_the_limit = false;
  double read_seconds = 0;  // of this rank

  // Runs a strategy between the cache's begin and end. After an error on all ranks none can be sure what the
  // others have, so all forget.
  Outcome exchange(const ExchangeStrategy& strategy, const Setup& setup);
};

Outcome LoadedSurvey::State::exchange(const ExchangeStrategy& strategy, const Setup& setup) {
  try {
    cache->begin_extraction();
    sent->begin_extraction();
    Outcome outcome = strategy.run(setup);
    outcome.cache_hits = cache->hits();
    sent->trim(setup.options.cache_bytes);
    if (cache->trim(setup.options.cache_bytes) && !told_of_the_limit) {
      told_of_the_limit = true;
      log::info("rank " + std::to_string(world.rank()) +
                ": one extraction alone needs more voxels of other " + "ranks than the cache's limit of " +
                std::to_string(setup.options.cache_bytes >> 20) +
                " MiB holds; it works, and moves them again the next time");
    }
    outcome.cache_voxels = cache->voxels();
    return outcome;
  } catch (...) {
    forget_cache();
    throw;
  }
}

LoadedSurvey::LoadedSurvey(const comm::Communicator& parent, const survey::Index& dims, const ReadBox& read,
                           const JobContext& job, std::array<int, 2> pillars) {
  const double start = omp_get_wtime();
  const comm::RankGrid grid = parent.collectively([&] {
    if (dims[0] < 1 || dims[1] < 1 || dims[2] < 1) {
      throw Error(ErrorCode::kInvalid, "the survey has no voxels");
    }
    return comm::RankGrid(dims, parent.size(), pillars);
  });
  state_ = std::make_unique<State>(parent, grid);
  read_blocks(state_->world, read, job, state_->blocks);
  state_->read_seconds = omp_get_wtime() - start;
}

LoadedSurvey::~LoadedSurvey() = default;

const comm::RankGrid& LoadedSurvey::grid() const {
  return state_->grid;
}

void LoadedSurvey::forget_cache() {
  state_->automatic.forget_cached();
  state_->forget_cache();
}

Result LoadedSurvey::extract(const Input& input, const Options& options, const JobContext& job) {
  const double start = omp_get_wtime();
  comm::Communicator& world = state_->world;
  const bool with_discontinuity = asks_for(options, "discontinuity");
  const std::vector<const Computation*> whole_face = whole_face_computations(options);
  world.collectively([&] { validate(options); });
  state_->automatic.prepare(world, options);
  Chosen chosen;
  Choice balance;
  Choice exchange_choice;
  double scale = 0;
  const std::vector<int> responsible = world.collectively([&] {
    require(input.dims == state_->grid.dims(), "faces of the survey that was read");
    voxelize::apply_forced_simd();
    if (with_discontinuity) scale = discontinuity_scale(input.max_abs);
    chosen = state_->automatic.decide(state_->grid, input.faces, options);
    balance = parse_choice(chosen.balance);
    exchange_choice = parse_choice(chosen.exchange);
    return balance_strategy(balance.name)
        .run({state_->grid, input.faces, balance, {}, {}, nullptr, chosen.costs});
  });
  const double balanced = omp_get_wtime();
  const comm::Traffic before = world.traffic();

  // 2 voxelize, 3 exchange, 4 compute
  const Setup setup{
      world,           state_->grid, state_->blocks,  *state_->cache,     *state_->sent, input,
      responsible,     options,      exchange_choice, with_discontinuity, scale,         whole_face,
      options.threads, job};
  const ExchangeStrategy& exchange = exchange_strategy(exchange_choice.name);
  Outcome outcome = state_->exchange(exchange, setup);
  const comm::Traffic after = world.traffic();

  Result result;
  result.faces = gathered(world, outcome.finished, input.faces.size());
  if (!whole_face.empty()) {
    result.blobs = gathered_blobs(world, std::move(outcome.blobs), whole_face, input.faces.size());
  }
  Report& report = result.report;
  report.exchange = chosen.exchange;
  report.balance = chosen.balance;
  report.reason = chosen.reason;
  report.predicted = chosen.predicted;
  report.ranks = world.size();
  report.threads = options.threads;
  report.faces = static_cast<std::int64_t>(input.faces.size());
  report.walked_here = outcome.walked;
  report.voxels = world.sum(outcome.walked);
  report.bytes_sent = world.sum(after.bytes - before.bytes);
  report.messages = world.sum(after.messages - before.messages);
  report.cache_hits = world.sum(outcome.cache_hits);
  report.cache_voxels = world.sum(outcome.cache_voxels);
  if (report.voxels > 0) {
    report.load_max_over_mean = static_cast<double>(world.maximum(outcome.walked)) * world.size() /
                                static_cast<double>(report.voxels);
  }
  const auto hash = static_cast<std::int64_t>(
      world.collectively([&] { return world.rank() == 0 ? checksum_of(input.faces, result.faces) : 0; }));
  report.checksum = static_cast<std::uint64_t>(world.sum(hash));  // the others add 0
  report.seconds.read = world.maximum(state_->read_seconds);
  report.seconds.balance = world.maximum(balanced - start);
  report.seconds.voxelize = world.maximum(outcome.seconds.voxelize);
  report.seconds.exchange = world.maximum(outcome.seconds.exchange);
  report.seconds.compute = world.maximum(outcome.seconds.compute);
  report.seconds.total = world.maximum(state_->read_seconds + omp_get_wtime() - start);
  state_->automatic.learn(report);
  if (chosen.is_new && world.rank() == 0 && world.size() > 1) {
    log::info("auto: " + report.reason);
    log::info("it took: " + outcome_in_words(report));
  }
  return result;
}

Result extract_all(const comm::Communicator& world, const Input& input, const Options& options,
                   const ReadBox& read, const JobContext& job) {
  world.collectively([&] { validate(options); });
  LoadedSurvey survey(world, input.dims, read, job.part(0, 0.5), options.pillars);
  return survey.extract(input, options, job.part(0.5, 0.95));
}

std::uint64_t checksum_of(std::span<const Face> faces, std::span<const FaceStatistics> statistics) {
  require(faces.size() == statistics.size(), "statistics of every face");
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(faces[a].fault, faces[a].owner, faces[a].n) <
           std::tie(faces[b].fault, faces[b].owner, faces[b].n);
  });
  Hasher hasher;
  std::vector<std::byte> bytes;
  for (const std::size_t n : order) {
    const FaceStatistics& face = statistics[n];
    bytes.clear();
    for (const std::int64_t whole : {faces[n].fault, faces[n].owner, std::int64_t{faces[n].n}, face.count,
                                     face.nulls, static_cast<std::int64_t>(face.outside)}) {
      append(whole, bytes);
    }
    for (const double value : {face.mean, face.variance, face.min, face.max, face.discontinuity}) {
      append(canonical(value), bytes);
    }
    hasher.add(bytes);
  }
  return hasher.value();
}

}  // namespace footwall::extract
