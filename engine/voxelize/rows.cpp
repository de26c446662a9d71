#include "engine/voxelize/rows.h"

namespace footwall::voxelize {
namespace {

class ListingSink final : public RowSink {
 public:
  explicit ListingSink(std::vector<Voxel>& out) : out_(out) {}
  void row(const Row& row) override {
    const auto u = static_cast<std::size_t>(row.u_axis);
    const auto w = static_cast<std::size_t>(row.w_axis);
    const std::size_t before = out_.size();
    out_.resize(before + static_cast<std::size_t>(voxels_in(row)));
    Voxel* next = out_.data() + before;
    Voxel voxel{};
    voxel[static_cast<std::size_t>(row.v_axis)] = static_cast<std::int32_t>(row.v);
    voxel[u] = static_cast<std::int32_t>(row.u0);
    for (std::size_t n = 0; n < row.lo.size(); ++n, ++voxel[u]) {
      for (std::int64_t at = row.lo[n]; at <= row.hi[n]; ++at) {
        voxel[w] = static_cast<std::int32_t>(at);
        *next++ = voxel;
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
