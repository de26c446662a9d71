// What a message costs among the ranks of a communicator, measured on the spot.
// Based on: the LogGP model (Alexandrov et al. 1995), and seed 004, equation 3.2, whose alpha and beta these
// are; differs in that beta is in seconds per byte (the seed's equations 3.2 and 3.5 disagree).
#pragma once
#include "engine/comm/communicator.h"

namespace footwall::comm {

struct LinkRates {
  double alpha = 0;     // s from an empty message's start on one rank to its end on another
  double overhead = 0;  // s that each further message of a burst adds
  double byte = 0;      // s per byte, both ways and all pairs of ranks at once
  friend bool operator==(const LinkRates&, const LinkRates&) = default;
};

// Messages both ways between ranks half a world apart, all pairs at once, and bursts of small messages from
// every rank to several partners. Before each, every rank looks at other memory and meets the others: so is
// it in an extraction, whose messages come between computations, and there a message costs tens of times what
// it costs in a tight loop of them. Medians over rounds of the slowest rank. The same on every rank;
// positive, but zeros for one rank, which sends nothing. Takes about `seconds`, and longer only where five
// rounds take longer. Collective; throws kEngine.
LinkRates measure_links(const Communicator& world, double seconds);

}  // namespace footwall::comm
