#include "engine/tasks/workload/run_parallel.h"

#include <omp.h>

#include <fmt/format.h>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/extract/extract.h"
#include "engine/extract/model/shared_model.h"
#include "engine/extract/registry.h"
#include "engine/tasks/workload/script.h"
#include "engine/tasks/workload/totals.h"
#include "engine/tasks/workload/values.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kScriptLimit = std::size_t{8} << 30;

// What every rank must know of a script: operations are broadcast when they are applied.
struct Plan {
  survey::Index size{0, 0, 0};
  std::vector<std::vector<std::uint8_t>> repeats;  // for each step, whether EXTRACT-ALL follows

  std::size_t steps() const {
    std::size_t count = 0;
    for (const auto& repeat : repeats) count += repeat.size();
    return count;
  }
};

Workload read_script(const std::filesystem::path& path) {
  try {
    return parse_script(read_whole_file(path, kScriptLimit));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kFormat) throw;
    throw Error(error.code(), fmt::format("{}: {}", path.string(), error.message()), error.hint());
  }
}

// Collective: rank 0's script, as a plan on every rank.
Plan shared_plan(const comm::Communicator& world, const Workload& workload) {
  // The size; for each repeat the number of its steps, and for each step whether EXTRACT-ALL follows.
  std::vector<std::int64_t> numbers;
  if (world.rank() == 0) {
    numbers.assign(workload.size.begin(), workload.size.end());
    for (const WorkloadRepeat& repeat : workload.repeats) {
      numbers.push_back(static_cast<std::int64_t>(repeat.steps.size()));
      for (const WorkloadStep& step : repeat.steps) numbers.push_back(step.extract ? 1 : 0);
    }
  }
  const auto raw = std::as_bytes(std::span(numbers));
  const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
  numbers.resize(bytes.size() / sizeof(std::int64_t));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  std::size_t at = 0;
  Plan plan;
  for (std::int64_t& count : plan.size) count = numbers[at++];
  while (at < numbers.size()) {
    auto& repeat = plan.repeats.emplace_back(static_cast<std::size_t>(numbers[at++]));
    for (std::uint8_t& extract : repeat) extract = static_cast<std::uint8_t>(numbers[at++]);
  }
  return plan;
}

// What was asked for, or what `auto` chose where that was always the same.
std::string ran(const std::string& asked, const std::map<std::string, std::int64_t>& names) {
  return asked == "auto" && names.size() == 1 ? names.begin()->first : asked;
}

struct Timed {
  WorkloadTotals totals;
  double seconds = 0;  // of this rank, of operations
};

class Runner {
 public:
  Runner(const comm::Communicator& world, const WorkloadRun& run, const JobContext& job)
      : world_(world), run_(run), job_(job), model_(world) {}

  void operator()() {
    // 1 Read the script; give the voxels their values.
    const Workload workload = world_.collectively([&] {
      extract::validate(run_.options);
      return world_.rank() == 0 ? read_script(run_.script) : Workload{};
    });
    const Plan plan = shared_plan(world_, workload);
    const double start = omp_get_wtime();
    const auto read = [&](const survey::Box& box, std::span<float> values) {
      fill_hashed(plan.size, run_.seed, box, values);
    };
    survey_.emplace(world_, plan.size, read, job_.part(0, 0.05), run_.options.pillars);
    read_seconds_ = omp_get_wtime() - start;

    // 2 The repeats.
    size_ = plan.size;
    all_steps_ = plan.steps();
    all_repeats_ = plan.repeats.size();
    for (std::size_t r = 0; r < plan.repeats.size(); ++r) {
      Timed& repeat = *repeats_.emplace_back(std::make_unique<Timed>());
      static const WorkloadRepeat kElsewhere;
      run_repeat(world_.rank() == 0 ? workload.repeats[r] : kElsewhere, plan.repeats[r], r, repeat);
    }

    // 3 The result.
    const Json result = result_of(workload);
    world_.collectively([&] {
      if (world_.rank() != 0) return;
      write_whole_file(run_.result, result.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
      job_.report(1, "write", "done");
    });
  }

 private:
  void run_repeat(const WorkloadRepeat& script, const std::vector<std::uint8_t>& steps, std::size_t number,
                  Timed& repeat) {
    if (number > 0 && !run_.keep_cache) survey_->forget_cache();
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto share = [&](std::size_t done) {
        return 0.05 + 0.93 * static_cast<double>(done) / static_cast<double>(all_steps_);
      };
      const JobContext part = job_.part(share(done_steps_), share(done_steps_ + 1));
      world_.collectively(
          [&] { part.report(0, "workload", fmt::format("repeat {} of {}", number + 1, all_repeats_)); });
      static const std::vector<mesh::Operation> kNone;
      const double start = omp_get_wtime();
      const extract::SharedModel::Outcome outcome =
          model_.apply(world_.rank() == 0 ? script.steps[s].operations : kNone);
      const double applied = omp_get_wtime() - start;
      if (!outcome.refusals.empty()) refuse(outcome.refusals.front(), number, s);
      if (steps[s] != 0) extract(part, repeat);
      repeat.seconds += omp_get_wtime() - start;
      const double slowest = world_.maximum(applied);
      repeat.totals.add_apply_seconds(slowest);
      totals_.add_apply_seconds(slowest);
      ++done_steps_;
    }
  }

  void extract(const JobContext& part, Timed& repeat) {
    const std::vector<extract::Face> faces = model_.faces();
    model_.take_changes();
    const extract::Input input{size_, 1.0, faces};
    const extract::Result result = survey_->extract(input, run_.options, part);
    repeat.totals.add(result);
    totals_.add(result);
  }

  // The refusals are the same on every rank, so that all come here.
  void refuse(const extract::SharedModel::Refusal& refusal, std::size_t repeat, std::size_t step) {
    world_.collectively([&] {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("repeat {}, operation {} after {} EXTRACT-ALLs: {}", repeat + 1,
                              refusal.operation + 1, step, refusal.reason.message()),
                  refusal.reason.hint().empty()
                      ? "mend the script: docs/workloads.md describes the operations"
                      : refusal.reason.hint());
    });
  }

  Json result_of(const Workload& workload) {
    double slowest = 0, quickest = 0;
    Json repeats = Json::array();
    double mine = 0;
    for (const auto& repeat : repeats_) {
      mine += repeat->seconds;
      repeats.push_back(
          repeat->totals.json(world_.maximum(repeat->seconds), -world_.maximum(-repeat->seconds)));
    }
    slowest = world_.maximum(mine);
    quickest = -world_.maximum(-mine);
    const double read = world_.maximum(read_seconds_);
    if (world_.rank() != 0) return {};
    const OperationCounts counts = counts_of(workload);
    Json result = totals_.json(slowest, quickest);
    const auto removes = counts.remove_faces + counts.remove_face;
    result.update({{"workload", run_.script.filename().string()},
                   {"size", workload.size},
                   {"ranks", world_.size()},
                   {"threads", run_.options.threads},
                   {"exchange", ran(run_.options.exchange, totals_.exchanges())},
                   {"balance", ran(run_.options.balance, totals_.balances())},
                   {"voxelizer", run_.options.voxelizer},
                   {"compute", run_.options.compute},
                   {"seed", run_.seed},
                   {"keep_cache", run_.keep_cache},
                   {"phases_apart", run_.options.phases_apart},
                   {"operations",
                    {{"adds", counts.adds()},
                     {"removes", removes},
                     {"moves", counts.move_vertex},
                     {"extracts", counts.extract_all},
                     {"create_mesh", counts.create_mesh},
                     {"destroy_mesh", counts.destroy_mesh},
                     {"add_face", counts.add_face},
                     {"remove_faces", counts.remove_faces},
                     {"remove_face", counts.remove_face},
                     {"move_vertex", counts.move_vertex},
                     {"split_edge", counts.split_edge},
                     {"extract_all", counts.extract_all}}},
                   {"exchanges", totals_.exchanges()},
                   {"balances", totals_.balances()},
                   {"repeats", repeats}});
    result["seconds"]["read"] = read;
    return result;
  }

  const comm::Communicator& world_;
  const WorkloadRun& run_;
  const JobContext& job_;
  extract::SharedModel model_;
  std::optional<extract::LoadedSurvey> survey_;
  survey::Index size_{0, 0, 0};
  double read_seconds_ = 0;
  std::size_t all_repeats_ = 0, all_steps_ = 0, done_steps_ = 0;
  WorkloadTotals totals_;
  std::vector<std::unique_ptr<Timed>> repeats_;
};

}  // namespace

void run_workload(const comm::Communicator& world, const WorkloadRun& run, const JobContext& job) {
  Runner(world, run, job)();
}

}  // namespace footwall::tasks
