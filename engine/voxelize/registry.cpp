#include "engine/voxelize/registry.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "engine/voxelize/exact.h"
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

template <class T>
std::unique_ptr<Voxelizer> make() {
  return std::make_unique<T>();
}

constexpr std::array kMethods = {
    Method{"exact", "every voxel whose closed cube meets the closed triangle, in integers", &make<Exact>},
    Method{"rotated", "rotation into the plane z = 0 and line rasterization, after Larsen", nullptr},
    Method{"kaufman", "scan between bounding planes, for comparison", nullptr},
    Method{"gpu", "rasterization through OpenGL", nullptr},
};

std::string built_names() {
  std::string names;
  for (const Method& method : kMethods) {
    if (method.make == nullptr) continue;
    if (!names.empty()) names += ", ";
    names += method.name;
  }
  return names;
}

}  // namespace

std::span<const Method> methods() {
  return kMethods;
}

std::unique_ptr<Voxelizer> make_voxelizer(std::string_view name) {
  // "rotated=lc" names a variant of rotated.
  const std::string_view family = name.substr(0, name.find('='));
  for (const Method& method : kMethods) {
    if (method.name != family) continue;
    if (method.make == nullptr) {
      throw Error(ErrorCode::kUsage, fmt::format("the voxelizer '{}' is not built in this version", name),
                  "use one of: " + built_names());
    }
    if (method.name == name) return method.make();
  }
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is not a voxelizer", name),
              "use one of: " + built_names());
}

}  // namespace footwall::voxelize
