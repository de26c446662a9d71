#include "engine/extract/computations.h"

#include <algorithm>
#include <array>

#include "engine/extract/face_filter.h"
#include "engine/extract/lot.h"
#include "engine/extract/registry.h"

namespace footwall::extract {
namespace {

constexpr std::array kComputations{
    Computation{"count", "voxels with a value", "1", true, true, 0, nullptr},
    Computation{"mean", "mean amplitude", "amplitude", true, true, 0, nullptr},
    Computation{"variance", "sample variance of the amplitude", "amplitude^2", true, true, 0, nullptr},
    Computation{"min", "smallest amplitude", "amplitude", true, true, 0, nullptr},
    Computation{"max", "largest amplitude", "amplitude", true, true, 0, nullptr},
    Computation{"discontinuity", "0 where the traces around are alike, towards 1 where they are not", "1",
                true, true, 1, nullptr},
    Computation{"contrast", "discontinuity of the face above that 6 voxels beside it, on both sides", "1",
                true, false, 1, nullptr},
    Computation{"offset", "how far beside the face the discontinuity is highest, up to 8 voxels", "voxel",
                true, false, 1, nullptr},
    Computation{"voxels", "the values of the voxels themselves, stored", "bytes", true, false, 0,
                &make_voxels, true},
    Computation{"lot", "the voxels' lapped orthogonal transform, stored with --snr", "bytes", true, false, 0,
                &make_lot, true},
    Computation{"filter", "the values of the face's voxels, band-passed or sharpened", "amplitude", true,
                false, 0, &make_face_filter, true}};

}  // namespace

std::span<const Computation> computations() {
  return kComputations;
}

std::vector<std::string> usual_computations() {
  std::vector<std::string> names;
  for (const Computation& row : kComputations) {
    if (row.by_default || row.name == "contrast") names.emplace_back(row.name);
  }
  return names;
}

const Computation& computation(std::string_view name) {
  find_row(statistic_rows(), "statistic", name);
  return *std::find_if(kComputations.begin(), kComputations.end(),
                       [&](const Computation& row) { return row.name == name; });
}

bool asks_for(const Options& options, std::string_view name) {
  if (options.compute.empty()) return computation(name).by_default;
  return std::find(options.compute.begin(), options.compute.end(), name) != options.compute.end();
}

std::vector<const Computation*> whole_face_computations(const Options& options) {
  std::vector<const Computation*> rows;
  for (const Computation& row : kComputations) {
    if (row.make != nullptr && asks_for(options, row.name)) rows.push_back(&row);
  }
  return rows;
}

}  // namespace footwall::extract
