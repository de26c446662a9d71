#include "engine/session/group_options.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/extract/cost/rates_file.h"
#include "engine/extract/machine_rates.h"
#include "engine/session/host_ranks.h"
#include "storage/base/usable_memory.h"

namespace footwall::session {
namespace {

render::GroupRates rates_of(const comm::Communicator& world, int threads) {
  const extract::MachineRates machine = extract::machine_rates(world, extract::rates_folder());
  render::GroupRates rates = world.collectively([] { return render::measure_drawing(); });
  const double turns = std::max(1.0, static_cast<double>(world.size()) / machine.cores);
  for (double render::GroupRates::*rate : render::kGroupRates) {
    // Of the slowest rank; ranks that take turns on a core have less of it each.
    rates.*rate = world.maximum(rates.*rate) * turns;
  }
  // The rest is done by one thread.
  const int cores = std::clamp(machine.cores / world.size(), 1, threads);
  rates.triangle /= cores;
  rates.drawn /= cores;
  rates.shaded /= cores;
  rates.geometry_byte += machine.byte;
  rates.merged += render::kMergedPixelBytes * machine.byte;
  return rates;
}

}  // namespace

render::GroupOptions group_options(const comm::Communicator& world, std::optional<double> threshold,
                                   int threads) {
  render::GroupOptions options;
  if (world.size() == 1) return options;
  constexpr int kShare = 4;
  options.memory = usable_memory().bytes / ranks_of_this_host(world) / kShare;
  if (threshold) {
    options.threshold = *threshold;
  } else {
    options.rates = rates_of(world, threads);
  }
  return options;
}

nlohmann::json json_of_threshold(std::optional<double> threshold) {
  return threshold ? nlohmann::json(*threshold) : nlohmann::json("auto");
}

std::optional<double> threshold_from(const nlohmann::json& json) {
  if (json == "auto") return std::nullopt;
  return json.get<double>();
}

}  // namespace footwall::session
