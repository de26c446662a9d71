// As minimum, but around each voxel that it lacks a rank asks for a block of B^3 voxels, so that more is
// there when the face has moved. Based on: seed 004, section 3.4.2 (strategy 2, block transfer).
#include "engine/extract/exchange/by_request.h"

namespace footwall::extract {
namespace {

constexpr std::int64_t kUsual = 2;  // as in the seed's runs
constexpr std::int64_t kMost = 64;

std::int64_t side_of(const Choice& choice) {
  choice.takes_at_most(1);
  return choice.whole(0, "block size", kUsual, 1, kMost);
}

}  // namespace

void check_block(const Choice& choice) {
  side_of(choice);
}

Outcome exchange_block(const Setup& setup) {
  return exchange_by_request(setup, side_of(setup.choice));
}

}  // namespace footwall::extract
