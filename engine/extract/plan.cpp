#include "engine/extract/plan.h"

#include "engine/extract/probes.h"
#include "engine/extract/registry.h"
#include "engine/extract/statistics/discontinuity.h"
#include "engine/voxelize/registry.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr int kMostThreads = 1024;
constexpr int kMostPillars = 1024;  // of a rank, along one axis

void check_numbers(const Options& options) {
  if (options.threads < 1 || options.threads > kMostThreads) {
    throw Error(ErrorCode::kUsage, "there cannot be " + std::to_string(options.threads) + " threads",
                "give 1 to 1024 threads for each rank");
  }
  for (const int pillars : options.pillars) {
    if (pillars >= 1 && pillars <= kMostPillars) continue;
    throw Error(ErrorCode::kUsage, "a rank cannot have " + std::to_string(pillars) + " pillars along an axis",
                "give two numbers from 1 to 1024, such as --pillars 2x2");
  }
  if (options.cache_bytes < 0) {
    throw Error(ErrorCode::kUsage, "a cache cannot have " + std::to_string(options.cache_bytes) + " bytes",
                "give 0 for none");
  }
}

}  // namespace

Plan plan_of(const Options& options, double max_abs) {
  Plan plan;
  plan.options = options;
  plan.exchange = parse_choice(options.exchange);
  plan.balance = parse_choice(options.balance);
  find_row(exchange_rows(), "exchange", plan.exchange.name);
  plan.strategy = &exchange_strategy(plan.exchange.name);
  plan.strategy->check(plan.exchange);
  find_row(balance_rows(), "balance", plan.balance.name);
  plan.balancer = &balance_strategy(plan.balance.name);
  plan.balancer->check(plan.balance);
  for (const std::string& name : options.compute) computation(name);
  voxelize::make_voxelizer(options.voxelizer);
  plan.whole_face = whole_face_computations(options);
  // "auto" takes sums where they are enough, else the strategy that moves the fewest bytes.
  if (!plan.whole_face.empty() && plan.exchange.name == "auto") plan.strategy = &exchange_strategy("push");
  if (!plan.whole_face.empty() && !plan.strategy->moves_voxels) {
    throw Error(ErrorCode::kUsage,
                "'" + std::string(plan.whole_face.front()->name) +
                    "' needs the voxels of a face, and exchange '" + plan.exchange.name + "' moves none",
                "use --exchange push");
  }
  for (const Computation* each : plan.whole_face) each->make(options);
  check_numbers(options);
  plan.with_discontinuity = asks_for(options, "discontinuity") || !probe_shifts(options).empty();
  if (plan.with_discontinuity) plan.scale = discontinuity_scale(max_abs);
  voxelize::apply_forced_simd();
  return plan;
}

std::string name_of_exchange(const Plan& plan) {
  return plan.exchange.name == "auto" ? std::string(plan.strategy->name) : plan.exchange.text();
}

void validate(const Options& options) {
  plan_of(options, 1);
}

}  // namespace footwall::extract
