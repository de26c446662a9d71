// Whether what a call is about to do fits into memory, asked before it begins: of each host for all of its
// ranks together.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/comm/communicator.h"

namespace footwall::service {

// "12.3 MiB", "4.5 GiB".
std::string in_words(std::int64_t bytes);

class HostMemory {
 public:
  // What the engine has on this rank, by its own count.
  struct Held {
    std::int64_t stays = 0;  // volumes and model
    std::int64_t kept = 0;   // only so that the next call is quick: goes where memory is short
  };

  // host_of: of each rank, the lowest rank of its host. host_bytes: what the engine may take on each host; 0:
  // what is free there.
  HostMemory(const comm::Communicator& world, std::vector<int> host_of, std::int64_t host_bytes)
      : world_(world), host_of_(std::move(host_of)), host_bytes_(host_bytes) {}

  std::function<Held()> held = [] { return Held{}; };
  // Gives back what is kept; alike on all ranks.
  std::function<void()> drop = [] {};

  // own: bytes that this rank needs besides. Where they are not free, what is kept is dropped first. Throws,
  // on all ranks alike, kMemory: "<what> needs 3.0 GiB on this host, 1.2 GiB are free". Collective.
  void require_free(std::int64_t own, const std::string& what, const std::string& hint) const;

 private:
  struct Short {
    std::int64_t needed = 0;
    std::int64_t free = 0;
  };
  // Of the first host that lacks the most; needed 0 where none does. Alike on all ranks.
  Short look(std::int64_t own) const;

  const comm::Communicator& world_;
  std::vector<int> host_of_;
  std::int64_t host_bytes_;
};

}  // namespace footwall::service
