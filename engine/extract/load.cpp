// Step 1 of EXTRACT-ALL: each rank reads its part of the volume.
#include <omp.h>

#include "engine/extract/loaded_survey.h"

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

}  // namespace

LoadedSurvey::LoadedSurvey(const comm::Communicator& parent, const survey::Index& dims, const ReadBox& read,
                           const JobContext& job, std::array<int, 2> pillars) {
  const double start = omp_get_wtime();
  const comm::RankGrid grid = parent.collectively([&] {
    if (dims[0] < 1 || dims[1] < 1 || dims[2] < 1) {
      throw Error(ErrorCode::kInvalid, "the survey has no voxels");
    }
    return comm::RankGrid(dims, parent.size(), pillars);
  });
  state_ = std::make_unique<State>(parent, grid, job);
  read_blocks(state_->world, read, job, state_->blocks);
  state_->read_seconds = omp_get_wtime() - start;
}

LoadedSurvey::~LoadedSurvey() = default;

const comm::RankGrid& LoadedSurvey::grid() const {
  return state_->grid;
}

}  // namespace footwall::extract
