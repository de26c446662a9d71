#include "engine/service/server/detail/token.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::service {
namespace {

constexpr std::size_t kShortest = 32;

}  // namespace

Token::Digest Token::digest_of(std::string_view text) {
  Digest digest{};
  unsigned int size = 0;
  require(EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr) == 1 &&
              size == digest.size(),
          "SHA-256");
  return digest;
}

Token::Token(const std::string& token) : digest_(digest_of(token)) {
  if (token.size() < kShortest) {
    throw Error(ErrorCode::kUsage, "the engine's token has fewer than 32 characters",
                "openssl rand -hex 32 makes one");
  }
}

bool Token::is(std::string_view offered) const {
  const Digest digest = digest_of(offered);
  return CRYPTO_memcmp(digest.data(), digest_.data(), digest.size()) == 0;
}

bool FailureRate::allows(Clock::time_point now) {
  const std::scoped_lock lock(mutex_);
  left_ = std::min(burst_, left_ + rate_ * std::chrono::duration<double>(now - last_).count());
  last_ = now;
  if (left_ < 1) return false;
  left_ -= 1;
  return true;
}

}  // namespace footwall::service
