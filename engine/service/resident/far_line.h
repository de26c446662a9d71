// Lines from rank 0's host to the other hosts: TCP connections between the engine's own ranks, on which a
// leader can sleep as its ranks do on a host line. Both ends prove themselves with a secret that they have by
// MPI, and the listener is gone as soon as the last leader has come: nobody else gets as far as a word. (Who
// can read or change what hosts say to each other could as well do so with MPI.)
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/service/resident/host_line.h"

namespace footwall::service {

// An address of a host, as it is sent around; network order.
struct HostAddress {
  std::int32_t family = 0;  // AF_INET, AF_INET6
  std::uint16_t port = 0;
  std::array<std::uint8_t, 16> bytes{};  // 4 of them for AF_INET
  std::array<std::uint8_t, 16> mask{};   // of its network
};

// Of all interfaces that are up, loopback among them, at most 64; without IPv6's link-local ones, which mean
// nothing elsewhere. Throws Error kIo.
std::vector<HostAddress> own_addresses();

// By which of `theirs` a host with the addresses `mine` reaches another, as bits: those in a network of both,
// or else all that are not its own, too (as a container's bridge is on every host); or else, where all is one
// machine, the loopback.
std::uint64_t ways_to(std::span<const HostAddress> theirs, std::span<const HostAddress> mine);

// Half of it is said by who calls, half by who answers.
using LineSecret = std::array<std::uint8_t, 64>;
LineSecret new_line_secret();

// Rank 0's end.
class FarListener {
 public:
  // On these addresses alone, at ports that are free; those that cannot be used now are left out. Throws
  // Error kIo where none is left.
  explicit FarListener(std::span<const HostAddress> where);
  std::vector<HostAddress> addresses() const;
  // Takes `lines` connections that know the secret. Strangers are hung up on; they cannot hold it up. Throws
  // Error kEngine where leaders do not come in time.
  std::vector<Descriptor> accept(int lines, const LineSecret& secret,
                                 std::chrono::milliseconds patience = std::chrono::seconds(60));

 private:
  struct Door {
    Descriptor listening;
    HostAddress address;
  };
  std::vector<Door> doors_;
};

// A leader's end: by the first of these addresses that knows the secret. Throws Error kEngine.
Descriptor reach(std::span<const HostAddress> addresses, const LineSecret& secret,
                 std::chrono::milliseconds patience_each = std::chrono::seconds(10));

}  // namespace footwall::service
