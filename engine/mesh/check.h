// The invariants of a mesh, checked the slow and obvious way from its faces' vertices alone.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/mesh/mesh.h"

namespace footwall::mesh {

// What is wrong, one line each, at most `limit` of them; empty for a sound mesh: records that point to each
// other, every edge with one or two faces that run it in opposite directions, every vertex with a single fan
// of faces, counts that agree, finite positions. Takes O(faces log faces).
std::vector<std::string> problems_of(const Mesh& mesh, std::size_t limit = 20);

// A hash of all that a mesh holds and will answer: relations, positions, the ids it will give next. Two
// meshes that differ in it differ; equal ones went through operations that had the same effect.
std::uint64_t state_hash(const Mesh& mesh);

}  // namespace footwall::mesh
