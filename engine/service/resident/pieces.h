// Long answers go in pieces, so that no message is large and a client sees the first ones early.
#pragma once
#include <cstddef>

namespace footwall::service {

inline constexpr std::size_t kFacesInPiece = std::size_t{1} << 14;

}  // namespace footwall::service
