#include "engine/voxelize/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "engine/voxelize/exact.h"
#include "engine/voxelize/kaufman.h"
#include "engine/voxelize/rotated.h"
#include "storage/base/error.h"

namespace footwall::voxelize {
namespace {

class Exact final : public Voxelizer {
 public:
  void rows(const survey::LatticeTriangle& triangle, const survey::Box& clip, RowSink& sink) override {
    exact_rows(triangle, clip, scratch_, sink);
  }

 private:
  ExactScratch scratch_;
};

// For methods that know nothing of threads.
template <class T>
std::unique_ptr<Voxelizer> make(int) {
  return std::make_unique<T>();
}

template <RotatedLoop Loop>
std::unique_ptr<Voxelizer> make_rotated(int threads) {
  return std::make_unique<Rotated>(Loop, threads);
}

constexpr std::array kRotatedLoops = {Variant{"lc", &make_rotated<RotatedLoop::kLc>},
                                      Variant{"plain", &make_rotated<RotatedLoop::kPlain>}};

constexpr std::array kMethods = {
    Method{"exact", "every voxel whose closed cube meets the closed triangle, in integers", true,
           &make<Exact>},
    Method{"rotated", "rotation into the plane z = 0 and line rasterization, after Larsen", false,
           &make_rotated<RotatedLoop::kLc>, kRotatedLoops, true},
    Method{"kaufman", "the bounding plane scanned from edge to edge, after Kaufman; thin", false,
           &make<Kaufman>},
    Method{.name = "gpu",
           .help = "rasterization by graphics hardware",
           .exact = false,
           .make = nullptr,
           .reason = "graphics processors round as they like, so that ranks would find different voxels"},
};

std::string built_names() {
  std::string names;
  for (const Method& method : kMethods) {
    if (method.make == nullptr) continue;
    if (!names.empty()) names += ", ";
    names += method.name;
    for (const Variant& variant : method.variants) {
      names += fmt::format(", {}={}", method.name, variant.parameter);
    }
  }
  return names;
}

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::kUsage, message, "use one of: " + built_names());
}

MakeVoxelizer maker_of(const Method& method, std::string_view name) {
  if (method.name == name) return method.make;
  const std::string_view parameter = name.substr(method.name.size() + 1);
  const auto variant = std::find_if(method.variants.begin(), method.variants.end(),
                                    [&](const Variant& each) { return each.parameter == parameter; });
  if (variant != method.variants.end()) return variant->make;
  if (method.variants.empty()) {
    refuse(fmt::format("the voxelizer '{}' takes no parameter '{}'", method.name, parameter));
  }
  refuse(fmt::format("the voxelizer '{}' has no variant '{}'", method.name, parameter));
}

}  // namespace

std::span<const Method> methods() {
  return kMethods;
}

const Method& method_of(std::string_view name) {
  const std::string_view family = name.substr(0, name.find('='));
  const auto* const method =
      std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& each) { return each.name == family; });
  if (method == kMethods.end()) refuse(fmt::format("'{}' is not a voxelizer", name));
  if (method->make == nullptr) {
    refuse(fmt::format("the voxelizer '{}' is not built in this version: {}", family, method->reason));
  }
  maker_of(*method, name);
  return *method;
}

std::unique_ptr<Voxelizer> make_voxelizer(std::string_view name, int threads) {
  require(threads >= 1, "at least one thread");
  return maker_of(method_of(name), name)(threads);
}

}  // namespace footwall::voxelize
