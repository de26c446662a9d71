// Rank 0's text on every rank.
#pragma once
#include <span>
#include <string>

#include "engine/comm/communicator.h"

namespace footwall::comm {

// Collective. What the other ranks give is not looked at.
inline std::string shared_text(const Communicator& world, const std::string& text) {
  const auto raw = std::as_bytes(std::span(text));
  const Bytes bytes = world.broadcast(Bytes(raw.begin(), raw.end()), 0);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace footwall::comm
