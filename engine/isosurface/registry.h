// The ways to extract an isosurface by name; the command line and the bench list themselves from here.
#pragma once
#include <span>
#include <string_view>

#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

struct Variant {
  std::string_view name;
  std::string_view help;  // one line
  void (*extract)(const Field& field, float isovalue, const ExtractOptions& options, Surface& into);
};

// The default one first.
std::span<const Variant> variants();
// Throws Error kUsage naming those there are.
const Variant& variant_of(std::string_view name);

}  // namespace footwall::isosurface
