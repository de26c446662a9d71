// What exchange strategies keep from one extraction to the next over the same survey: buffers, and remote
// voxels. Each strategy makes its own member on first use; a member that is there belongs to this survey,
// grid and rank.
#pragma once
#include <memory>

#include "engine/extract/exchange/message_rooms.h"

namespace footwall::extract {

class ReduceBuffers;

struct Kept {
  Kept();
  ~Kept();
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  MessageRooms messages;  // of the strategy that runs: one at a time does
  std::unique_ptr<ReduceBuffers> reduce;
};

}  // namespace footwall::extract
