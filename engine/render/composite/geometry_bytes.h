// Surfaces as bytes, to be sent to another rank.
#pragma once
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/render/lit_surface.h"

namespace footwall::render {

// How many bytes bytes_of() takes.
std::int64_t size_of(std::span<const LitSurface> surfaces);
comm::Bytes bytes_of(std::span<const LitSurface> surfaces);
// Throws Error kCorrupt for other bytes.
std::vector<OwnedSurface> surfaces_from(std::span<const std::byte> bytes);

}  // namespace footwall::render
