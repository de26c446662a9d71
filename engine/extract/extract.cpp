#include "engine/extract/extract.h"

#include <omp.h>

#include "engine/extract/auto_choice.h"
#include "engine/extract/balance/area.h"
#include "engine/extract/loaded_survey.h"
#include "engine/extract/probes.h"
#include "engine/extract/registry.h"
#include "engine/extract/report.h"
#include "storage/base/log.h"

namespace footwall::extract {

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

void run_exchange(LoadedSurvey::State& state, const Plan& plan, const Input& input,
                  std::span<const int> responsible, const JobContext& job, Ran& ran) {
  comm::Communicator& world = state.world;
  const comm::Traffic before = world.traffic();
  const double of_faces = 1 / static_cast<double>(1 + probe_shifts(plan.options).size());  // of the time
  const JobContext faces_job = job.part(0, of_faces);
  const Setup setup{world,
                    state.grid,
                    state.blocks,
                    state.remote->cache(),
                    state.remote->sent(),
                    input,
                    responsible,
                    plan.options,
                    plan.exchange,
                    plan.with_discontinuity,
                    plan.scale,
                    plan.whole_face,
                    plan.options.threads,
                    state.kept,
                    faces_job};
  if (plan.strategy->moves_voxels) {
    ran.outcome = state.remote->run(*plan.strategy, setup);
    state.directory.add(input.faces, responsible);
  } else {
    ran.outcome = plan.strategy->run(setup);
  }
  if (!probe_shifts(plan.options).empty()) {
    world.agree(ran.outcome.failure);
    run_probes(setup, job.part(of_faces, 1), ran.outcome);
  }
  ran.traffic = {world.traffic().bytes - before.bytes, world.traffic().messages - before.messages};
  state.gather.statistics(world, responsible, ran.outcome.finished, ran.faces);
}

Tally tally_of(const Ran& ran) {
  Tally tally;
  tally.sums.walked = tally.most_walked = ran.outcome.walked;
  tally.sums.bytes = tally.most_bytes = ran.traffic.bytes;
  tally.sums.messages = tally.most_messages = ran.traffic.messages;
  tally.sums.cache_hits = ran.outcome.cache_hits;
  tally.sums.cache_voxels = ran.outcome.cache_voxels;
  return tally;
}

const Seconds& LoadedSurvey::own_seconds() const {
  return state_->own_seconds;
}

void LoadedSurvey::forget_cache() {
  state_->forget_cache();
}

Result LoadedSurvey::extract(const Input& input, const Options& options, const JobContext& job) {
  const double start = omp_get_wtime();
  comm::Communicator& world = state_->world;
  if (state_->validated != options) {
    world.collectively([&] { validate(options); });
    state_->automatic.prepare(world, options);
    state_->validated = options;
  }
  Chosen chosen;
  Plan plan;
  Ran ran;
  const std::vector<int> responsible = world.collectively([&] {
    chosen = state_->automatic.decide(state_->grid, input.faces, options);
    Options settled = options;
    settled.exchange = chosen.exchange;
    settled.balance = chosen.balance;
    plan = plan_of(settled, input.max_abs);
    require(input.dims == state_->grid.dims(), "faces of the survey that was read");
    std::vector<int> ranks = plan.balancer->run(state_->to_balance(plan, input.faces, {}, chosen.costs));
    state_->gather.prepare(world, ranks, ran.faces);
    return ranks;
  });
  const double balanced = omp_get_wtime();

  run_exchange(*state_, plan, input, responsible, job, ran);

  Tally mine = tally_of(ran);
  Result result;
  std::optional<Error> failure = std::move(ran.outcome.failure);
  try {
    if (!failure && world.rank() == 0) {
      orient_offsets(input.faces, ran.faces);
      mine.sums.checksum = static_cast<std::int64_t>(checksum_of(input.faces, ran.faces));
    }
    const std::vector<FixedArea> areas = fixed_areas(input.faces);
    result.report.loads = loads_of(areas, responsible, world.size());
    result.report.load_deviation = load_deviation(result.report.loads);
  } catch (...) {
    failure = comm::current_error();
  }
  Seconds& seconds = ran.outcome.seconds;
  seconds.read = state_->read_seconds;
  seconds.balance = balanced - start;
  seconds.total = omp_get_wtime() - start + state_->read_seconds;
  mine.set(seconds);
  state_->own_seconds = seconds;
  const Tally all = together(world, mine, failure);

  result.faces = std::move(ran.faces);
  if (!plan.whole_face.empty()) {
    result.blobs = gather_blobs(world, std::move(ran.outcome.blobs), plan.whole_face, input.faces.size());
  }
  Report& report = result.report;
  fill_report(all, world.size(), report);
  report.exchange = chosen.exchange;
  report.balance = chosen.balance;
  report.reason = chosen.reason;
  report.predicted = chosen.predicted;
  report.threads = options.threads;
  report.faces = static_cast<std::int64_t>(input.faces.size());
  report.walked_here = ran.outcome.walked;
  state_->automatic.learn(report);
  if (chosen.is_new && world.rank() == 0 && world.size() > 1) {
    log::info("auto: " + report.reason);
    log::info("it took: " + outcome_in_words(report));
  }
  return result;
}

std::vector<FaultStatistics> LoadedSurvey::faults(const Input& input, const Options& options,
                                                  const JobContext& job) {
  const Plan plan = state_->world.collectively([&] {
    require(input.dims == state_->grid.dims(), "faces of the survey that was read");
    return plan_of(options, input.max_abs);
  });
  return fault_statistics({state_->world,
                           state_->grid,
                           state_->blocks,
                           state_->remote->cache(),
                           state_->remote->sent(),
                           input,
                           {},
                           plan.options,
                           plan.exchange,
                           plan.with_discontinuity,
                           plan.scale,
                           {},
                           plan.options.threads,
                           state_->kept,
                           job});
}

Result extract_all(const comm::Communicator& world, const Input& input, const Options& options,
                   const ReadBox& read, const JobContext& job) {
  world.collectively([&] { validate(options); });
  LoadedSurvey survey(world, input.dims, read, job.part(0, 0.5), options.pillars);
  return survey.extract(input, options, job.part(0.5, 0.95));
}

}  // namespace footwall::extract
