#include "engine/voxelize/exact.h"

#include "engine/voxelize/detail/row_loop.h"
#include "engine/voxelize/detail/setup.h"
#include "engine/voxelize/simd.h"

namespace footwall::voxelize {
namespace {

class CountingSink final : public RowSink {
 public:
  void row(const Row& row) override { voxels_ += voxels_in(row); }
  std::int64_t voxels() const { return voxels_; }

 private:
  std::int64_t voxels_ = 0;
};

class VisitingSink final : public RowSink {
 public:
  explicit VisitingSink(const std::function<void(const survey::Index&)>& visit) : visit_(visit) {}
  void row(const Row& row) override {
    survey::Index voxel{};
    voxel[row.v_axis] = row.v;
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      voxel[row.u_axis] = row.u0 + static_cast<std::int64_t>(n);
      for (std::int64_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        voxel[row.w_axis] = w;
        visit_(voxel);
      }
    }
  }

 private:
  const std::function<void(const survey::Index&)>& visit_;
};

}  // namespace

struct ExactScratch::Buffers {
  detail::RowBuffers rows;
};

ExactScratch::ExactScratch() : buffers_(std::make_unique<Buffers>()) {
  apply_forced_simd();
}
ExactScratch::~ExactScratch() = default;
ExactScratch::ExactScratch(ExactScratch&&) noexcept = default;
ExactScratch& ExactScratch::operator=(ExactScratch&&) noexcept = default;

void exact_rows(const survey::LatticeTriangle& triangle, const survey::Box& clip, ExactScratch& scratch,
                RowSink& sink) {
  const detail::Setup setup = detail::setup_of(triangle, clip);
  if (!setup.box.empty()) detail::emit_rows(setup, scratch.buffers().rows, sink);
}

std::int64_t count(const survey::LatticeTriangle& triangle, const survey::Box& clip, ExactScratch& scratch) {
  CountingSink sink;
  exact_rows(triangle, clip, scratch, sink);
  return sink.voxels();
}

void for_each_voxel(const survey::LatticeTriangle& triangle, const survey::Box& clip, ExactScratch& scratch,
                    const std::function<void(const survey::Index&)>& visit) {
  VisitingSink sink(visit);
  exact_rows(triangle, clip, scratch, sink);
}

std::vector<survey::Index> list(const survey::LatticeTriangle& triangle, const survey::Box& clip,
                                ExactScratch& scratch) {
  std::vector<survey::Index> voxels;
  for_each_voxel(triangle, clip, scratch, [&](const survey::Index& voxel) { voxels.push_back(voxel); });
  return voxels;
}

survey::Box bounding_voxels(const survey::LatticeTriangle& triangle) {
  return detail::bounding_voxels(detail::corners_of(triangle));
}

}  // namespace footwall::voxelize
