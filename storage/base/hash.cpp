#include "storage/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>
#include <system_error>

#include <charconv>

#include "storage/base/error.h"

namespace footwall {

std::uint64_t hash64(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

struct Hasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  ~State() { XXH3_freeState(xxh); }
  State() {
    if (xxh == nullptr || XXH3_64bits_reset(xxh) == XXH_ERROR) {
      throw Error(ErrorCode::kMemory, "not enough memory for a hash state");
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;

void Hasher::add(std::span<const std::byte> bytes) {
  require(XXH3_64bits_update(state_->xxh, bytes.data(), bytes.size()) == XXH_OK, "XXH3 update failed");
}

std::uint64_t Hasher::value() const {
  return XXH3_64bits_digest(state_->xxh);
}

std::string to_hex(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

std::uint64_t hash_from_hex(const std::string& digits) {
  std::uint64_t hash = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, failure] = std::from_chars(digits.data(), end, hash, 16);
  if (failure != std::errc{} || stop != end || digits.size() != 16) {
    throw Error(ErrorCode::kFormat, fmt::format("'{}' is not a checksum of 16 hexadecimal digits", digits));
  }
  return hash;
}

}  // namespace footwall
