// The voxelization methods by name; the command line, the bench and the batch job list themselves from here.
#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "engine/voxelize/rows.h"

namespace footwall::voxelize {

// Makes a voxelizer that runs on `threads` threads inside one triangle, if it can.
using MakeVoxelizer = std::unique_ptr<Voxelizer> (*)(int threads);

struct Variant {
  std::string_view parameter;  // as in "rotated=lc"
  MakeVoxelizer make;
};

struct Method {
  std::string_view name;
  std::string_view help;  // one line
  // Whether it finds exactly the voxels whose cube meets the triangle (`exact` by definition); the bench
  // compares it with the definition if so, and counts what it misses and adds if not.
  bool exact;
  MakeVoxelizer make;                   // null: known by name, not built
  std::span<const Variant> variants{};  // what may follow "="; none: nothing may
  bool threads_inside = false;          // whether threads share out one triangle
  std::string_view reason{};            // why it is not built
};

// All methods, the default one first.
std::span<const Method> methods();
// The method of a name that may carry a parameter. Throws as make_voxelizer.
const Method& method_of(std::string_view name);

// A voxelizer of its own for the calling thread; `threads` >= 1 work inside one triangle where the method can
// and the triangle is large, with the same result. Throws Error kUsage for a method that is not built (and
// says why) or not known, or a parameter that it does not take (and lists those there are).
std::unique_ptr<Voxelizer> make_voxelizer(std::string_view name = "exact", int threads = 1);

}  // namespace footwall::voxelize
