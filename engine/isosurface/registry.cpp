#include "engine/isosurface/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "engine/isosurface/cubes.h"
#include "engine/isosurface/extract.h"
#include "engine/isosurface/plane.h"
#include "engine/isosurface/vector.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr std::array kVariants = {
    Variant{"bricks", "signs as bits, exact sizes first, bricks skipped by their ranges", &extract},
    Variant{"cubes", "cell by cell, the base line", &extract_cubes},
    Variant{"plane", "two planes at a time, as seed 000", &extract_plane},
    Variant{"vector", "arrays without branches, as seed 002", &extract_vector},
};

}  // namespace

std::span<const Variant> variants() {
  return kVariants;
}

const Variant& variant_of(std::string_view name) {
  const auto* const found = std::find_if(kVariants.begin(), kVariants.end(),
                                         [&](const Variant& each) { return each.name == name; });
  if (found != kVariants.end()) return *found;
  std::string names;
  for (const Variant& each : kVariants) names += fmt::format("{}{}", names.empty() ? "" : ", ", each.name);
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is not a way to extract an isosurface", name),
              "use one of: " + names);
}

}  // namespace footwall::isosurface
