// The voxelization methods by name; the command line, the bench and the batch job list themselves from here.
#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "engine/voxelize/rows.h"

namespace footwall::voxelize {

struct Method {
  std::string_view name;
  std::string_view help;                 // one line
  std::unique_ptr<Voxelizer> (*make)();  // null: known by name, not built
};

// All methods, the default one first.
std::span<const Method> methods();

// A voxelizer of its own for the calling thread. Throws Error kUsage for a method that is not built (and says
// so) or not known (and lists those there are).
std::unique_ptr<Voxelizer> make_voxelizer(std::string_view name = "exact");

}  // namespace footwall::voxelize
