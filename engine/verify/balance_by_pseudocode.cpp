#include "engine/verify/balance_by_pseudocode.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace footwall::verify {
namespace {

bool is_fixed(const BalanceCase& given, std::size_t face) {
  return !given.fixed.empty() && given.fixed[face];
}

// Areas of the faces with each responsible rank.
std::vector<std::int64_t> total_areas(const BalanceCase& given, const std::vector<int>& responsible) {
  std::vector<std::int64_t> total(static_cast<std::size_t>(given.ranks), 0);
  for (std::size_t f = 0; f < given.areas.size(); ++f)
    total[static_cast<std::size_t>(responsible[f])] += given.areas[f];
  return total;
}

std::int64_t mean_of(const BalanceCase& given) {
  return std::accumulate(given.areas.begin(), given.areas.end(), std::int64_t{0}) / given.ranks;
}

// Gives faces of i to k, again and again the largest that fits into what is left of `room`; returns A(S).
std::int64_t give(const BalanceCase& given, int i, int k, std::int64_t room, std::vector<int>& responsible) {
  std::int64_t sum = 0;
  for (;;) {
    std::size_t best = given.areas.size();
    for (std::size_t f = 0; f < given.areas.size(); ++f) {
      if (responsible[f] != i || is_fixed(given, f) || given.areas[f] == 0) continue;
      if (given.areas[f] > room - sum) continue;
      if (best == given.areas.size() || given.areas[f] > given.areas[best]) best = f;
    }
    if (best == given.areas.size()) return sum;
    responsible[best] = k;
    sum += given.areas[best];
  }
}

}  // namespace

std::vector<int> global_by_pseudocode(const BalanceCase& given) {
  std::vector<int> responsible = given.start;
  std::vector<std::int64_t> total = total_areas(given, responsible);
  const std::int64_t mean = mean_of(given);
  for (int i = 0; i < given.ranks; ++i) {
    std::int64_t& of_i = total[static_cast<std::size_t>(i)];
    if (of_i <= mean + given.threshold) continue;
    std::int64_t target = of_i - mean;
    std::vector<int> sorted;
    for (int j = 0; j < given.ranks; ++j) {
      if (j != i) sorted.push_back(j);
    }
    std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) {
      return total[static_cast<std::size_t>(a)] < total[static_cast<std::size_t>(b)];
    });
    for (const int k : sorted) {
      std::int64_t& of_k = total[static_cast<std::size_t>(k)];
      const std::int64_t most = mean - of_k;
      if (most <= 0 || target <= 0) break;
      const std::int64_t given_away = give(given, i, k, std::min(target, most), responsible);
      target -= given_away;
      of_i -= given_away;
      of_k += given_away;
    }
  }
  return responsible;
}

std::vector<int> manhattan_by_pseudocode(const BalanceCase& given, int tau,
                                         const std::function<int(int, int)>& distance) {
  std::vector<int> responsible = given.start;
  std::vector<std::int64_t> total = total_areas(given, responsible);
  const std::int64_t mean = mean_of(given);
  for (int i = 0; i < given.ranks; ++i) {
    std::int64_t& of_i = total[static_cast<std::size_t>(i)];
    if (of_i <= mean + given.threshold) continue;
    std::int64_t target = of_i - (mean + given.threshold);
    for (int ring = 1; ring <= (tau < 0 ? 2 * given.ranks : tau); ++ring) {
      for (int k = 0; k < given.ranks && target > 0; ++k) {
        std::int64_t& of_k = total[static_cast<std::size_t>(k)];
        if (distance(i, k) != ring || of_k >= mean) continue;
        const std::int64_t most = mean + given.threshold - of_k;
        const std::int64_t given_away = give(given, i, k, std::min(target, most), responsible);
        target -= given_away;
        of_i -= given_away;
        of_k += given_away;
      }
    }
  }
  return responsible;
}

std::vector<int> local_by_pseudocode(const BalanceCase& given,
                                     const std::function<bool(int, std::size_t)>& meets, bool running) {
  std::vector<int> responsible = given.start;
  std::vector<std::int64_t> areas(static_cast<std::size_t>(given.ranks), 0);
  std::int64_t met = 0;
  const auto count = [&](std::size_t f) {
    areas[static_cast<std::size_t>(responsible[f])] += given.areas[f];
    met += given.areas[f];
  };
  for (std::size_t f = 0; f < given.areas.size(); ++f) {
    if (is_fixed(given, f)) count(f);
  }
  const std::int64_t final_mean = mean_of(given);
  for (std::size_t f = 0; f < given.areas.size(); ++f) {
    if (is_fixed(given, f)) continue;
    const std::int64_t mean = running ? met / given.ranks : final_mean;
    if (areas[static_cast<std::size_t>(given.start[f])] > mean + given.threshold && given.areas[f] > 0) {
      int least = given.start[f];
      for (int i = 0; i < given.ranks; ++i) {
        if (meets(i, f) && areas[static_cast<std::size_t>(i)] < areas[static_cast<std::size_t>(least)]) {
          least = i;
        }
      }
      responsible[f] = least;
    }
    count(f);
  }
  return responsible;
}

}  // namespace footwall::verify
