// The clock of an exchange: the seconds of this rank in each phase.
#pragma once
#include "engine/extract/exchange/exchange.h"

namespace footwall::extract {

class Phases {
 public:
  // Starts in Seconds::voxelize.
  explicit Phases(const Setup& setup);

  // What follows belongs to `phase`.
  void enter(double Seconds::*phase);
  // Whether the waiting for slower ranks is to be told apart from the exchange.
  bool apart() const { return setup_.options.phases_apart; }
  // Before and after messages that all ranks take part in: where phases are to be apart, waits until every
  // rank is here, so that none computes on a core that another one needs for its messages. Collective.
  void meet();
  // Ends the last phase.
  const Seconds& end();

 private:
  const Setup& setup_;
  Seconds seconds_;
  double Seconds::*phase_ = &Seconds::voxelize;
  double since_;
};

}  // namespace footwall::extract
