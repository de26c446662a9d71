#include "engine/render/composite/halving.h"

#include "storage/base/error.h"

namespace footwall::render {

Halving::Halving(int ranks) : ranks_(ranks) {
  require(ranks >= 1, "at least one rank");
  while (core_ <= ranks / 2) {
    core_ *= 2;
    ++steps_;
  }
}

int Halving::partner(int rank, int step) const {
  if (step == 0) {
    if (rank >= core_) return rank - core_;
    return rank + core_ < ranks_ ? rank + core_ : -1;
  }
  return rank < core_ ? rank ^ (1 << (step - 1)) : -1;
}

Rows Halving::rows(int rank, int steps_done, Rows whole) const {
  if (steps_done > 0 && gives(rank)) return {whole.begin, whole.begin};
  for (int step = 1; step < steps_done; ++step) {
    const int middle = whole.begin + whole.count() / 2;
    if ((rank >> (step - 1) & 1) != 0) {
      whole.begin = middle;
    } else {
      whole.end = middle;
    }
  }
  return whole;
}

}  // namespace footwall::render
