#include "engine/voxelize/rows.h"

namespace footwall::voxelize {
namespace {

class ListingSink final : public RowSink {
 public:
  explicit ListingSink(std::vector<Voxel>& out) : out_(out) {}
  void row(const Row& row) override {
    Voxel voxel{};
    voxel[static_cast<std::size_t>(row.v_axis)] = static_cast<std::int32_t>(row.v);
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      voxel[static_cast<std::size_t>(row.u_axis)] =
          static_cast<std::int32_t>(row.u0 + static_cast<std::int64_t>(n));
      for (std::int64_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        voxel[static_cast<std::size_t>(row.w_axis)] = static_cast<std::int32_t>(w);
        out_.push_back(voxel);
      }
    }
  }

 private:
  std::vector<Voxel>& out_;
};

}  // namespace

void Voxelizer::raster(const survey::LatticeTriangle& triangle, const survey::Box& clip,
                       std::vector<Voxel>& out) {
  out.clear();
  ListingSink sink(out);
  rows(triangle, clip, sink);
}

void Voxelizer::visits(const survey::LatticeTriangle& triangle, const survey::Box& clip,
                       std::vector<Voxel>& out) {
  raster(triangle, clip, out);
}

}  // namespace footwall::voxelize
