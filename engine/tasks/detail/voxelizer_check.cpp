#include "engine/tasks/detail/voxelizer_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "engine/verify/raster_by_definition.h"
#include "engine/verify/voxel_oracle.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

using survey::Box;
using survey::Index;
using survey::LatticeTriangle;
using voxelize::Voxel;

constexpr std::size_t kCheckedTriangles = 64;
constexpr std::int64_t kWholeTriangle = 40000;  // cubes in a bounding box that is checked whole
constexpr std::int64_t kWindow = 8;             // half the side of the boxes that are checked of larger ones
constexpr double kLargestBox = 2e7;             // half the surface of one whose pixels are checked
constexpr std::int64_t kMostPixels = 3000000;   // that are checked against the formulas, of all triangles

[[noreturn]] void wrong(std::size_t triangle, const std::string& what) {
  throw Error(ErrorCode::kInternal, fmt::format("the voxels of triangle {} {}", triangle, what),
              "please report this with the triangles");
}

// Lists the voxels, and whether they came in order.
class OrderedSink final : public voxelize::RowSink {
 public:
  void row(const voxelize::Row& row) override {
    Index voxel{};
    voxel[static_cast<std::size_t>(row.v_axis)] = row.v;
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      voxel[static_cast<std::size_t>(row.u_axis)] = row.u0 + static_cast<std::int64_t>(n);
      for (std::int64_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        voxel[static_cast<std::size_t>(row.w_axis)] = w;
        const Index at = {row.v, voxel[static_cast<std::size_t>(row.u_axis)], w};
        ascending = ascending && (voxels.empty() || last_ < at);
        last_ = at;
        voxels.push_back(voxel);
      }
    }
  }
  std::vector<Index> voxels;
  bool ascending = true;

 private:
  Index last_{};
};

// The boxes in which a triangle's answer is compared with the definition: all of it, or around its corners
// and middle.
std::vector<Box> boxes_to_check(const LatticeTriangle& t) {
  const Box whole = survey::grown(voxelize::bounding_voxels(t), 1);
  if (whole.size(0) < 4096 && whole.size(1) < 4096 && whole.size(2) < 4096 &&
      whole.count() <= kWholeTriangle) {
    return {whole};
  }
  const auto around = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    const Index at = {i / survey::kLatticePerVoxel, j / survey::kLatticePerVoxel,
                      k / survey::kLatticePerVoxel};
    return survey::grown({at, at}, kWindow);
  };
  std::vector<Box> boxes;
  Index sum = {0, 0, 0};
  for (const auto& p : t) {
    boxes.push_back(around(p.i, p.j, p.k));
    sum = {sum[0] + p.i, sum[1] + p.j, sum[2] + p.k};
  }
  boxes.push_back(around(sum[0] / 3, sum[1] / 3, sum[2] / 3));
  return boxes;
}

std::vector<Index> listed(voxelize::Voxelizer& voxelizer, std::size_t n, const LatticeTriangle& triangle,
                          const Box& box) {
  OrderedSink sink;
  voxelizer.rows(triangle, box, sink);
  if (!sink.ascending) wrong(n, "come out of order or twice");
  std::sort(sink.voxels.begin(), sink.voxels.end());
  return std::move(sink.voxels);
}

// The box cut in eight around its middle.
void check_parts(voxelize::Voxelizer& voxelizer, std::size_t n, const LatticeTriangle& triangle,
                 const Box& box) {
  std::vector<Index> joined;
  for (int part = 0; part < 8; ++part) {
    Box piece = box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t cut = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
      (((part >> axis) & 1) != 0 ? piece.lo : piece.hi)[axis] = cut;
    }
    for (const Index& voxel : listed(voxelizer, n, triangle, piece)) {
      if (!piece.contains(voxel)) wrong(n, "lie outside the box asked for");
      joined.push_back(voxel);
    }
  }
  std::sort(joined.begin(), joined.end());
  if (joined != listed(voxelizer, n, triangle, box)) wrong(n, "are others when the box is cut");
}

void check_pixels(voxelize::Voxelizer& voxelizer, std::size_t n, const LatticeTriangle& triangle,
                  VoxelizerCheck& check) {
  const Box whole = voxelize::bounding_voxels(triangle);
  const auto area = static_cast<double>(whole.size(0)) * static_cast<double>(whole.size(1)) +
                    static_cast<double>(whole.size(1)) * static_cast<double>(whole.size(2)) +
                    static_cast<double>(whole.size(2)) * static_cast<double>(whole.size(0));
  if (area > kLargestBox || check.cubes > kMostPixels) return;
  const verify::RotatedPixels pixels = verify::rotated_by_formulas(triangle);
  if (pixels.doubtful) return;
  std::vector<Voxel> voxels;
  voxelizer.visits(triangle, kAllVoxels, voxels);
  if (!verify::are_rounded(pixels, voxels, triangle)) wrong(n, "are not those of the formulas");
  check.cubes += static_cast<std::int64_t>(pixels.position.size());
  ++check.triangles;
}

bool has_area(const LatticeTriangle& t) {
  const auto minor = [&](std::int32_t survey::LatticePoint::*a, std::int32_t survey::LatticePoint::*b) {
    return static_cast<long double>(std::int64_t{t[1].*a} - t[0].*a) *
               static_cast<long double>(std::int64_t{t[2].*b} - t[0].*b) -
           static_cast<long double>(std::int64_t{t[1].*b} - t[0].*b) *
               static_cast<long double>(std::int64_t{t[2].*a} - t[0].*a);
  };
  using P = survey::LatticePoint;
  return minor(&P::i, &P::j) != 0 || minor(&P::j, &P::k) != 0 || minor(&P::k, &P::i) != 0;
}

std::vector<Voxel> sorted(std::vector<Voxel> voxels) {
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

}  // namespace

VoxelizerCheck check_voxelizer(const std::string& name, std::span<const LatticeTriangle> triangles,
                               const JobContext& job) {
  const voxelize::Method& method = voxelize::method_of(name);
  const auto voxelizer = voxelize::make_voxelizer(name);
  VoxelizerCheck check;
  const std::size_t sample = std::min(triangles.size(), kCheckedTriangles);
  for (std::size_t s = 0; s < sample; ++s) {
    job.check();
    const std::size_t n = s * triangles.size() / sample;
    const LatticeTriangle& triangle = triangles[n];
    const bool by_kaufman = method.name == "kaufman" && has_area(triangle);
    for (const Box& box : boxes_to_check(triangle)) {
      check_parts(*voxelizer, n, triangle, box);
      if (!method.exact && !by_kaufman) continue;
      const std::vector<Index> expected = method.exact ? verify::voxels_by_definition(triangle, box)
                                                       : verify::kaufman_by_definition(triangle, box);
      if (listed(*voxelizer, n, triangle, box) != expected) wrong(n, "are not those of the definition");
      check.cubes += box.count();
    }
    if (method.exact || by_kaufman) ++check.triangles;
    if (method.name == "rotated") check_pixels(*voxelizer, n, triangle, check);
  }
  return check;
}

VoxelDifferences differences_from_exact(const std::string& name, std::span<const LatticeTriangle> triangles,
                                        std::int64_t budget, const JobContext& job) {
  const auto voxelizer = voxelize::make_voxelizer(name);
  const auto exact = voxelize::make_voxelizer("exact");
  VoxelDifferences found;
  std::vector<Voxel> visits;
  std::vector<Voxel> all;
  // 37 is odd, so that its multiples go through the 512 sign combinations once.
  const std::size_t stride = budget > 0 && triangles.size() % 37 != 0 ? 37 : 1;
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    if (budget > 0 && found.exact >= budget) break;
    job.check();
    const LatticeTriangle& triangle = triangles[s * stride % triangles.size()];
    voxelizer->visits(triangle, kAllVoxels, visits);
    exact->raster(triangle, kAllVoxels, all);
    visits = sorted(std::move(visits));
    all = sorted(std::move(all));
    const std::size_t before = visits.size();
    visits.erase(std::unique(visits.begin(), visits.end()), visits.end());
    std::vector<Voxel> shared;
    std::set_intersection(visits.begin(), visits.end(), all.begin(), all.end(), std::back_inserter(shared));
    found.repeated += static_cast<std::int64_t>(before - visits.size());
    found.exact += static_cast<std::int64_t>(all.size());
    found.missed += static_cast<std::int64_t>(all.size() - shared.size());
    found.extra += static_cast<std::int64_t>(visits.size() - shared.size());
    ++found.triangles;
  }
  return found;
}

}  // namespace footwall::tasks
