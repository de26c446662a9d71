#include "engine/tasks/bench_gather.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "engine/extract/face_order.h"
#include "engine/extract/fold_rows.h"
#include "engine/tasks/detail/voxelizer_check.h"
#include "engine/verify/statistics_by_definition.h"
#include "engine/verify/voxel_oracle.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"
#include "storage/base/splitmix64.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {
namespace {

using extract::Face;
using survey::Index;
using Vector = std::array<double, 3>;

constexpr int kMostRuns = 1000;
constexpr std::size_t kCheckedFaces = 24;
constexpr std::int64_t kCheckedCubes = 100'000;  // in the box that is checked of a face
constexpr std::int64_t kWindow = 20;             // half its side around the middle of a large one

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : numbers_(seed) {}
  // Uniform in [least, most).
  double within(double least, double most) { return least + (most - least) * numbers_.unit(); }
  Vector direction() {
    const double z = within(-1, 1);
    const double angle = within(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  SplitMix64 numbers_;
};

float value_of(const Index& p) {
  const auto key = static_cast<std::uint64_t>((p[0] * 4096 + p[1]) * 4096 + p[2]);
  return static_cast<float>(static_cast<double>(mixed(key + 1) >> 40) * 0x1p-11 - 4096);
}

// Corners on a circle, not too near to each other.
survey::LatticeTriangle random_triangle(double mean_area, const Index& dims, Numbers& numbers) {
  std::array<double, 3> at{};
  double area = 0;  // for a circle of radius 1
  do {
    for (double& each : at) each = numbers.within(0, 2 * std::numbers::pi);
    std::sort(at.begin(), at.end());
    area = 0.5 * std::abs(std::sin(at[1] - at[0]) + std::sin(at[2] - at[1]) + std::sin(at[0] - at[2]));
  } while (area < 0.3);
  const Vector a = numbers.direction();
  Vector b{};
  double length = 0;
  do {
    b = numbers.direction();
    const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (std::size_t axis = 0; axis < 3; ++axis) b[axis] -= along * a[axis];
    length = std::sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
  } while (length < 0.1);
  const double size = std::sqrt(mean_area * numbers.within(0.5, 1.5) / area);
  Vector centre{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    centre[axis] = numbers.within(0, static_cast<double>(dims[axis]));
  static const survey::Lattice lattice{survey::Geometry{}};
  survey::LatticeTriangle triangle;
  for (std::size_t n = 0; n < 3; ++n) {
    Vector p{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = centre[axis] + size * (std::cos(at[n]) * a[axis] + std::sin(at[n]) * b[axis] / length);
    triangle[n] = lattice.from_index({p[0], p[1], p[2]});
  }
  return triangle;
}

class CountingSink final : public voxelize::RowSink {
 public:
  void row(const voxelize::Row& row) override { voxels += voxelize::voxels_in(row); }
  std::int64_t voxels = 0;
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void fill(extract::Block& block, const JobContext& job) {
  const survey::Box all = block.wanted();
  std::vector<float> slab;
  for (std::int64_t i = all.lo[0]; i < all.hi[0]; ++i) {
    job.check();
    survey::Box box = all;
    box.lo[0] = i;
    box.hi[0] = i + 1;
    slab.clear();
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) slab.push_back(value_of({i, j, k}));
    }
    block.put(box, slab);
  }
}

void check_options(const GatherOptions& options) {
  if (options.runs < 1 || options.runs > kMostRuns)
    throw Error(ErrorCode::kUsage, fmt::format("{} runs; 1 to {} are possible", options.runs, kMostRuns));
  for (const double area : options.areas) {
    if (!(area >= 1 && area <= 1e8))
      throw Error(ErrorCode::kUsage, fmt::format("a mean area of {} voxel^2; 1 to 1e8 are possible", area));
  }
  if (!voxelize::method_of(options.voxelizer).exact) {
    throw Error(ErrorCode::kUsage,
                fmt::format("the sums of '{}' cannot be checked against the definition", options.voxelizer),
                "use --voxelizer exact");
  }
}

class Bench {
 public:
  Bench(const GatherOptions& options, const Index& dims, const JobContext& job)
      : options_(options), job_(job), block_({{0, 0, 0}, dims}, dims), folder_(block_, false, 0) {
    fill(block_, job);
    voxelizer_ = voxelize::make_voxelizer(options.voxelizer);
  }

  GatherRow row(double area, std::int64_t& checked) {
    make_faces(area);
    checked += check();
    GatherRow row;
    row.area = area;
    row.faces = static_cast<std::int64_t>(faces_.size());
    extract::FaceOrder order;
    order.of(faces_);
    std::vector<std::int64_t> by_place;
    for (std::size_t n = 0; n < order.size(); ++n) by_place.push_back(static_cast<std::int64_t>(order[n]));
    std::vector<std::int64_t> as_listed = by_place;
    std::sort(as_listed.begin(), as_listed.end());
    row.voxels = fold(as_listed);  // also warms what can be warmed
    std::vector<double> spans;
    std::vector<double> listed;
    std::vector<double> ordered;
    for (int run = 0; run < options_.runs; ++run) {
      job_.report(static_cast<double>(run) / options_.runs, "gather",
                  fmt::format("area {:g}, run {} of {}", area, run + 1, options_.runs));
      spans.push_back(seconds_of([&] { return count(as_listed); }, row.voxels));
      listed.push_back(seconds_of([&] { return fold(as_listed); }, row.voxels));
      ordered.push_back(seconds_of([&] { return fold(by_place); }, row.voxels));
    }
    const auto voxels = static_cast<double>(row.voxels);
    row.spans = voxels / median(spans);
    row.folded = voxels / median(listed);
    row.folded_ordered = voxels / median(ordered);
    return row;
  }

 private:
  void make_faces(double area) {
    Numbers numbers(2007);
    faces_.clear();
    CountingSink sink;
    while (sink.voxels < options_.voxels) {
      Face face;
      face.n = static_cast<std::int32_t>(faces_.size());
      face.triangle = random_triangle(area, dims(), numbers);
      voxelizer_->rows(face.triangle, block_.own(), sink);
      faces_.push_back(face);
    }
  }

  Index dims() const { return block_.own().hi; }

  // All of the face that lies in the block, or a part around its middle.
  survey::Box box_to_check(const survey::LatticeTriangle& t) const {
    const survey::Box whole = survey::intersection(voxelize::bounding_voxels(t), block_.own());
    if (whole.count() <= kCheckedCubes) return whole;
    constexpr std::int64_t kScale = std::int64_t{3} * survey::kLatticePerVoxel;
    const Index middle = {(std::int64_t{t[0].i} + t[1].i + t[2].i) / kScale,
                          (std::int64_t{t[0].j} + t[1].j + t[2].j) / kScale,
                          (std::int64_t{t[0].k} + t[1].k + t[2].k) / kScale};
    return survey::intersection(whole, survey::grown({middle, middle}, kWindow));
  }

  std::int64_t check() {
    std::int64_t checked = 0;
    const std::size_t sample = std::min(faces_.size(), kCheckedFaces);
    for (std::size_t s = 0; s < sample; ++s) {
      job_.check();
      const Face& face = faces_[s * faces_.size() / sample];
      const survey::Box box = box_to_check(face.triangle);
      std::vector<float> values;
      for (const Index& voxel : verify::voxels_by_definition(face.triangle, box))
        values.push_back(value_of(voxel));
      voxelizer_->rows(face.triangle, box, folder_);
      const extract::Moments found = folder_.take().moments;
      if (found.count != static_cast<std::int64_t>(values.size()))
        throw Error(ErrorCode::kInternal, "a face was folded over other voxels than those of the definition");
      if (values.empty()) continue;
      const auto expected = verify::moments_by_definition(values);
      if (found.mean() != expected.mean || found.variance() != expected.variance)
        throw Error(ErrorCode::kInternal, "the sums of a face are not those of the definition");
      ++checked;
    }
    return checked;
  }

  std::int64_t count(const std::vector<std::int64_t>& order) {
    CountingSink sink;
    for (const std::int64_t n : order)
      voxelizer_->rows(faces_[static_cast<std::size_t>(n)].triangle, block_.own(), sink);
    return sink.voxels;
  }

  std::int64_t fold(const std::vector<std::int64_t>& order) {
    std::int64_t voxels = 0;
    for (const std::int64_t n : order) {
      voxelizer_->rows(faces_[static_cast<std::size_t>(n)].triangle, block_.own(), folder_);
      voxels += folder_.take().voxels();
    }
    return voxels;
  }

  template <typename Walk>
  double seconds_of(Walk&& walk, std::int64_t expected) const {
    const double start = processor_seconds();
    const std::int64_t voxels = walk();
    const double seconds = processor_seconds() - start;
    if (voxels != expected) throw Error(ErrorCode::kInternal, "two runs walked over different voxels");
    return seconds;
  }

  const GatherOptions& options_;
  const JobContext& job_;
  extract::Block block_;
  extract::RowFolder folder_;
  std::unique_ptr<voxelize::Voxelizer> voxelizer_;
  std::vector<Face> faces_;
};

}  // namespace

GatherResult bench_gather(const GatherOptions& options, const JobContext& job) {
  check_options(options);
  GatherResult result;
  result.simd = voxelize::simd_in_use();
  result.dims = options.from_memory ? Index{400, 400, 200} : Index{96, 96, 96};
  const auto bench = std::make_unique<Bench>(options, result.dims, job);
  for (const double area : options.areas) result.rows.push_back(bench->row(area, result.checked_faces));
  job.report(1, "done");
  return result;
}

}  // namespace footwall::tasks
