// Results of any length, one for each face.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace footwall::extract {

// The results of one whole-face computation, face by face.
struct FaceBlobs {
  std::string computation;             // its name in computations.h
  std::vector<std::uint64_t> offsets;  // faces + 1; face n has bytes [offsets[n], offsets[n + 1])
  std::vector<std::byte> bytes;

  std::span<const std::byte> of(std::size_t face) const {
    return std::span(bytes).subspan(offsets.at(face), offsets.at(face + 1) - offsets.at(face));
  }
};

}  // namespace footwall::extract
