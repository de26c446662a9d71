// The 64-bit hash behind every checksum on disk (XXH3): fast, not cryptographic.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "storage/base/job_context.h"

namespace footwall {

std::uint64_t hash64(std::span<const std::byte> bytes);

// The same hash over pieces that come one after another.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  void add(std::span<const std::byte> bytes);
  // The hash of the bytes so far.
  std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// 16 lower-case hexadecimal digits, and back; throws Error kFormat for anything else.
std::string to_hex(std::uint64_t hash);
std::uint64_t hash_from_hex(const std::string& digits);

}  // namespace footwall
