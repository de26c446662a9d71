// Bytes as a zlib stream, made quickly.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace footwall::service {

// Level 1. Throws Error kMemory.
std::string deflated(std::span<const std::byte> bytes);

}  // namespace footwall::service
