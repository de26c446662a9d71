// What the ranks tell each other of an extraction: amounts, seconds and whether one of them failed, in one
// Allreduce.
#pragma once
#include <array>
#include <optional>

#include "engine/comm/communicator.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/face.h"

namespace footwall::extract {

// Of one rank before together(), of all after it.
struct Tally {
  struct Sums {
    std::int64_t walked = 0;
    std::int64_t bytes = 0;
    std::int64_t messages = 0;
    std::int64_t checksum = 0;  // of the one rank that knows it, 0 of the others
    std::int64_t cache_hits = 0;
    std::int64_t cache_voxels = 0;
    std::int64_t failed = 0;
  } sums;
  // Of the rank that has most.
  std::int64_t most_walked = 0;
  std::int64_t most_bytes = 0;
  std::int64_t most_messages = 0;
  // Of the slowest rank, and of the quickest with a minus sign: read, balance, voxelize, exchange, compute,
  // wait, total.
  std::array<double, 7> slowest{};
  std::array<double, 7> quickest{};

  void set(const Seconds& seconds);
  Seconds slowest_seconds() const;
  Seconds quickest_seconds() const;
};

// Sums and maxima over all ranks. Where one failed, every rank throws the error of the lowest of them.
// Collective: one Allreduce.
Tally together(const comm::Communicator& world, Tally mine, const std::optional<Error>& failure);

// Writes what the ranks found into a report.
void fill_report(const Tally& all, int ranks, Report& report);

}  // namespace footwall::extract
