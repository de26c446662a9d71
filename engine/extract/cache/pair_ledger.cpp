#include "engine/extract/cache/pair_ledger.h"

#include <algorithm>
#include <tuple>

namespace footwall::extract {

void PairLedger::enter(const BrickList& list, std::int64_t time) {
  for (const BrickMask& each : list) {
    const survey::Index brick{each.brick[0], each.brick[1], each.brick[2]};
    count_ -= voxels_in(in(brick));
    voxels_.add(each);
    count_ += voxels_in(in(brick));
    times_.resize(static_cast<std::size_t>(voxels_.bricks()));
    const std::int64_t slot = voxels_.slot(brick);
    if (slot >= 0) times_[static_cast<std::size_t>(slot)] = time;
  }
}

BrickList PairLedger::missing(const BrickList& wanted) const {
  BrickList rest;
  rest.reserve(wanted.size());
  for (const BrickMask& each : wanted) {
    const Mask& here = in({each.brick[0], each.brick[1], each.brick[2]});
    BrickMask lacking = each;
    for (std::size_t w = 0; w < here.size(); ++w) lacking.mask[w] &= ~here[w];
    if (!none(lacking.mask)) rest.push_back(lacking);
  }
  return rest;
}

std::vector<PairLedger::Gone> PairLedger::keep(std::int64_t most) {
  if (bricks() <= most) return {};
  std::vector<Gone> gone;
  for (std::int64_t slot = 0; slot < bricks(); ++slot) {
    gone.push_back({voxels_.brick_of(slot), times_[static_cast<std::size_t>(slot)]});
  }
  const auto surplus = gone.begin() + (bricks() - most);
  std::nth_element(gone.begin(), surplus, gone.end(), [](const Gone& a, const Gone& b) {
    return std::tie(a.time, a.brick) < std::tie(b.time, b.brick);
  });
  gone.erase(surplus, gone.end());
  for (const Gone& each : gone) {
    count_ -= voxels_in(in(each.brick));
    times_[static_cast<std::size_t>(voxels_.slot(each.brick))] = times_.back();
    times_.pop_back();
    voxels_.drop(each.brick);
  }
  return gone;
}

}  // namespace footwall::extract
