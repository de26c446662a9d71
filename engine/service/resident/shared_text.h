// Rank 0's text on every rank.
#pragma once
#include <string>

#include "engine/comm/communicator.h"

namespace footwall::service {

// Collective.
inline std::string shared_text(const comm::Communicator& world, const std::string& text) {
  const auto raw = std::as_bytes(std::span(text));
  const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace footwall::service
