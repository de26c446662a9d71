#include "engine/extract/fault_statistics.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>

#include "engine/extract/exchange/exchange.h"
#include "engine/extract/fold_rows.h"
#include "engine/extract/parallel_faces.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"

namespace footwall::extract {
namespace {

constexpr std::int64_t kWordBits = 64;

// One bit for each voxel of a box; the samples of a trace fill whole words. Bits may be set by several
// threads at once.
class Bitmap {
 public:
  explicit Bitmap(const survey::Box& box)
      : box_(box),
        words_of_trace_((box.size(2) + kWordBits - 1) / kWordBits),
        words_(static_cast<std::size_t>(traces() * words_of_trace_)) {}

  const survey::Box& box() const { return box_; }
  std::int64_t traces() const { return box_.size(0) * box_.size(1); }

  void set(const survey::Index& p) {
    const std::int64_t k = p[2] - box_.lo[2];
    const std::int64_t trace = (p[0] - box_.lo[0]) * box_.size(1) + p[1] - box_.lo[1];
    const std::atomic_ref<std::uint64_t> word(
        words_[static_cast<std::size_t>(trace * words_of_trace_ + k / kWordBits)]);
    word.fetch_or(std::uint64_t{1} << (k % kWordBits), std::memory_order_relaxed);
  }

  // visit(survey::Index) for every bit set in a trace, ascending.
  template <typename Visit>
  void for_each(std::int64_t trace, Visit&& visit) const {
    const std::int64_t i = box_.lo[0] + trace / box_.size(1);
    const std::int64_t j = box_.lo[1] + trace % box_.size(1);
    for (std::int64_t w = 0; w < words_of_trace_; ++w) {
      std::uint64_t left = words_[static_cast<std::size_t>(trace * words_of_trace_ + w)];
      for (; left != 0; left &= left - 1)
        visit(survey::Index{i, j, box_.lo[2] + w * kWordBits + std::countr_zero(left)});
    }
  }

 private:
  survey::Box box_;
  std::int64_t words_of_trace_;
  std::vector<std::uint64_t> words_;
};

class Marker final : public voxelize::RowSink {
 public:
  explicit Marker(Bitmap& bitmap) : bitmap_(bitmap) {}
  void row(const voxelize::Row& row) override {
    survey::Index p{};
    p[static_cast<std::size_t>(row.v_axis)] = row.v;
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      p[static_cast<std::size_t>(row.u_axis)] = row.u0 + static_cast<std::int64_t>(n);
      for (std::int64_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        p[static_cast<std::size_t>(row.w_axis)] = w;
        bitmap_.set(p);
      }
    }
  }

 private:
  Bitmap& bitmap_;
};

// The places in the input of each fault's faces.
std::map<std::int64_t, std::vector<std::size_t>> faces_by_fault(std::span<const Face> faces) {
  std::map<std::int64_t, std::vector<std::size_t>> by_fault;
  for (std::size_t n = 0; n < faces.size(); ++n) by_fault[faces[n].fault].push_back(n);
  return by_fault;
}

survey::Box united(const survey::Box& a, const survey::Box& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  survey::Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::min(a.lo[axis], b.lo[axis]);
    box.hi[axis] = std::max(a.hi[axis], b.hi[axis]);
  }
  return box;
}

using Voxelizers = std::vector<std::unique_ptr<voxelize::Voxelizer>>;  // one for each thread

Partial folded(const Setup& setup, const Block& block, const Bitmap& bitmap) {
  std::vector<std::unique_ptr<RowFolder>> folders(static_cast<std::size_t>(setup.threads));
  for (auto& folder : folders)
    folder = std::make_unique<RowFolder>(block, setup.with_discontinuity, setup.scale);
  std::exception_ptr failure;
#pragma omp parallel for num_threads(setup.threads) schedule(static)
  for (std::int64_t trace = 0; trace < bitmap.traces(); ++trace) {
    try {
      RowFolder& folder = *folders[static_cast<std::size_t>(omp_get_thread_num())];
      bitmap.for_each(trace, [&](const survey::Index& voxel) { folder.place(block.offset(voxel)); });
    } catch (...) {
#pragma omp critical(footwall_fault_statistics)
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  Partial sum;
  for (auto& folder : folders) sum.merge(folder->take());
  return sum;
}

// The distinct voxels of some faces in one block.
Partial folded(const Setup& setup, const Block& block, const std::vector<std::size_t>& faces,
               Voxelizers& voxelizers) {
  survey::Box box;
  for (const std::size_t n : faces) {
    const survey::Box around = voxelize::bounding_voxels(setup.face(n).triangle);
    box = united(box, survey::intersection(around, block.own()));
  }
  if (box.empty()) return {};
  Bitmap bitmap(box);
  parallel_faces(faces.size(), setup.threads, setup.job, "faults", [&](std::size_t thread, std::size_t n) {
    Marker marker(bitmap);
    voxelizers[thread]->rows(setup.face(faces[n]).triangle, box, marker);
  });
  return folded(setup, block, bitmap);
}

}  // namespace

std::vector<FaultStatistics> fault_statistics(const Setup& setup) {
  // 1 Every rank folds the distinct voxels of its own part.
  const auto by_fault = setup.world.collectively([&] { return faces_by_fault(setup.input.faces); });
  const std::vector<comm::Bytes> parts = setup.world.exchange(setup.world.collectively([&] {
    std::vector<comm::Bytes> outgoing(static_cast<std::size_t>(setup.world.size()));
    Voxelizers voxelizers(static_cast<std::size_t>(setup.threads));
    for (auto& voxelizer : voxelizers) voxelizer = voxelize::make_voxelizer(setup.options.voxelizer);
    for (const auto& [fault, faces] : by_fault) {
      Partial partial;
      for (const Block& block : setup.blocks.all()) partial.merge(folded(setup, block, faces, voxelizers));
      if (partial.voxels() > 0) encode(fault, partial, outgoing[0]);
    }
    return outgoing;
  }));
  // 2 Rank 0 merges the exact sums.
  return setup.world.collectively([&] {
    std::vector<FaultStatistics> all;
    if (setup.world.rank() != 0) return all;
    std::map<std::int64_t, Partial> sums;
    for (const comm::Bytes& bytes : parts) {
      std::span<const std::byte> rest(bytes);
      while (!rest.empty()) {
        Partial part;
        const std::int64_t fault = decode(rest, part);
        sums[fault].merge(part);
      }
    }
    for (const auto& [fault, faces] : by_fault) {
      const bool all_inside = std::all_of(faces.begin(), faces.end(), [&](std::size_t n) {
        return inside(setup.face(n).triangle, setup.input.dims);
      });
      all.push_back({fault, static_cast<std::int64_t>(faces.size()), finish(sums[fault], all_inside)});
    }
    return all;
  });
}

}  // namespace footwall::extract
