// Faces as bytes: "FWFACES1", their number (uint64), 56 bytes each (fault int64, owner int64, n int32, three
// lattice points of i, j, k int32), and the hash64 of all that (uint64). Little-endian.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::session {

std::string faces_to_bytes(std::span<const extract::Face> faces);
// Throws Error kFormat (not such a file), kCorrupt (cut or altered).
std::vector<extract::Face> faces_from_bytes(std::string_view bytes);

}  // namespace footwall::session
