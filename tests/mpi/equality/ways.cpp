#include "mpi/equality/ways.h"

#include <fmt/format.h>

#include "rounds.h"

namespace footwall::extract {

std::vector<Way> every_pair() {
  std::vector<Way> ways;
  for (std::size_t e = 0; e < kExchanges.size(); ++e) {
    for (std::size_t b = 0; b < kBalances.size(); ++b) {
      for (std::size_t pillars = 0; pillars < kPillars.size(); ++pillars)
        ways.push_back(
            {kExchanges[e], kBalances[b], 1 + static_cast<int>((e + b + pillars) % kMostThreads), pillars});
    }
  }
  return ways;
}

std::vector<Way> covering_ways(std::size_t turn) {
  std::vector<Way> ways;
  for (std::size_t e = 0; e < kExchanges.size(); ++e) {
    for (std::size_t b = 0; b < kBalances.size(); ++b)
      ways.push_back({kExchanges[e], kBalances[b], 1, (e + b + turn) % 2});
    for (int threads = 2; threads <= static_cast<int>(kMostThreads); ++threads)
      ways.push_back({kExchanges[e], "minimal", threads, (e + static_cast<std::size_t>(threads) + turn) % 2});
  }
  return ways;
}

bool is_thorough() {
  return rounds(1) > 1;
}

std::vector<Way> some_of(const std::vector<Way>& ways, std::size_t one_in, std::size_t turn) {
  if (is_thorough()) return ways;
  std::vector<Way> some;
  for (std::size_t n = turn % one_in; n < ways.size(); n += one_in) some.push_back(ways[n]);
  return some;
}

std::string name_of(const Way& way) {
  return fmt::format("{} with {}, {} threads, pillars {}x{}", way.exchange, way.balance, way.threads,
                     kPillars[way.pillars][0], kPillars[way.pillars][1]);
}

Options options_of(const Way& way, const std::string& voxelizer, std::vector<std::string> compute) {
  Options options;
  options.exchange = way.exchange;
  options.balance = way.balance;
  options.threads = way.threads;
  options.pillars = kPillars[way.pillars];
  options.voxelizer = voxelizer;
  options.compute = std::move(compute);
  options.snr = 40;
  return options;
}

}  // namespace footwall::extract
