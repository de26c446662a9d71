// The ways to extract that may not change a bit of the results.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

inline const std::vector<std::string> kExchanges{"minimum", "block=2", "block=3", "bounding",
                                                 "push",    "reduce",  "auto"};
inline const std::vector<std::string> kBalances{"none",        "global=0",      "local=0", "local=0,cache",
                                                "manhattan=0", "manhattan=0,2", "minimal", "auto"};
inline constexpr std::array<std::array<int, 2>, 2> kPillars{{{1, 1}, {2, 2}}};
inline constexpr std::size_t kMostThreads = 3;

struct Way {
  std::string exchange;
  std::string balance;
  int threads;
  std::size_t pillars;  // a place in kPillars
};

// Every exchange with every balancer and both pillars; the number of threads goes round.
std::vector<Way> every_pair();

// Fewer, for cases that take long: every exchange with every balancer on one thread; every exchange with
// `minimal`, which moves faces everywhere, on 2 and 3 threads. Pillars alternate so that over two `turn`s,
// such as two voxelizers, each of these pairs has met both.
std::vector<Way> covering_ways(std::size_t turn);

// Under the label slow all of them, else one in so many, which ones depending on the turn.
std::vector<Way> some_of(const std::vector<Way>& ways, std::size_t one_in, std::size_t turn);

// Whether this is the run that leaves nothing out.
bool is_thorough();

std::string name_of(const Way& way);

Options options_of(const Way& way, const std::string& voxelizer, std::vector<std::string> compute);

}  // namespace footwall::extract
