// How often a test repeats its random cases: `usual` times, and under the label slow, which sets
// FOOTWALL_TEST_FACTOR, that many times as often.
#pragma once
#include <cstdlib>

namespace footwall {

inline int rounds(int usual) {
  const char* factor = std::getenv("FOOTWALL_TEST_FACTOR");
  const int times = factor == nullptr ? 1 : std::atoi(factor);
  return times > 1 ? usual * times : usual;
}

}  // namespace footwall
