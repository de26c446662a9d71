#include "engine/voxelize/rotated.h"

#include <algorithm>
#include <exception>

#include "engine/voxelize/detail/pixel_loop.h"
#include "engine/voxelize/detail/setup.h"
#include "engine/voxelize/detail/voxel_set.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"

namespace footwall::voxelize {

using survey::Box;
using survey::LatticeTriangle;

struct Rotated::Buffers {
  detail::Edges edges;
  std::vector<detail::PixelColumn> columns;
  std::vector<std::vector<Voxel>> parts;  // of the plain loop, one for each thread
  std::vector<Voxel> pixels;
  detail::VoxelSet set;
};

namespace {

detail::Axes axes_of(const LatticeTriangle& triangle) {
  const detail::Corners corners = detail::corners_of(triangle);
  return detail::axes_of(corners, detail::normal_of(corners));
}

constexpr std::int64_t kManyPixels = 16384;  // for which a team of threads pays

// E.3.3: the x are shared out so that all threads have about as many pixels.
void by_lc(const detail::FlatTriangle& flat, const Box& clip, int threads, const detail::Edges& edges,
           std::vector<detail::PixelColumn>& columns, std::vector<Voxel>& out) {
  const std::int64_t total = detail::columns_below(edges, flat, clip, columns);
  out.resize(static_cast<std::size_t>(total));
  const int team = total < kManyPixels ? 1 : threads;
#pragma omp parallel for num_threads(team) schedule(static, 1) if (team > 1)
  for (int part = 0; part < team; ++part) {
    const auto starts_at = [&](int p) {
      return std::partition_point(columns.begin(), columns.end(), [&](const detail::PixelColumn& column) {
        return column.before < total * p / team;
      });
    };
    const auto end = part + 1 == team ? columns.end() : starts_at(part + 1);
    for (auto column = part == 0 ? columns.begin() : starts_at(part); column != end; ++column) {
      if (column->size() == 0) continue;
      detail::turn_back(flat, column - columns.begin(), column->first,
                        {out.data() + column->before, static_cast<std::size_t>(column->size())});
    }
  }
}

// E.3.2: each thread has as many x as the others.
void by_looking(const detail::FlatTriangle& flat, const Box& clip, int threads, const detail::Edges& edges,
                std::vector<std::vector<Voxel>>& parts, std::vector<Voxel>& out) {
  const std::int64_t width = flat.x3 + 1;
  const int team = flat.x3 * flat.y2 / 2 < kManyPixels ? 1 : threads;
  if (parts.size() < static_cast<std::size_t>(team)) parts.resize(static_cast<std::size_t>(team));
  std::exception_ptr failure;
#pragma omp parallel for num_threads(team) schedule(static, 1) if (team > 1)
  for (int part = 0; part < team; ++part) {
    try {
      std::vector<Voxel>& mine = parts[static_cast<std::size_t>(part)];
      mine.clear();
      detail::look_and_turn_back(flat, edges, width * part / team, width * (part + 1) / team, clip, mine);
    } catch (...) {  // no memory; an exception may not leave a parallel region
#pragma omp critical(footwall_rotated)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  out.clear();
  for (int part = 0; part < team; ++part) {
    const std::vector<Voxel>& each = parts[static_cast<std::size_t>(part)];
    out.insert(out.end(), each.begin(), each.end());
  }
}

}  // namespace

Rotated::Rotated(RotatedLoop loop, int threads)
    : buffers_(std::make_unique<Buffers>()), loop_(loop), threads_(threads) {
  require(threads >= 1, "at least one thread");
  apply_forced_simd();
}

Rotated::~Rotated() = default;

void Rotated::visits(const LatticeTriangle& triangle, const Box& clip, std::vector<Voxel>& out) {
  out.clear();
  const Box box = survey::intersection(detail::bounding_voxels(detail::corners_of(triangle)), clip);
  if (box.empty()) return;
  const detail::FlatTriangle flat = detail::flatten(triangle);
  if (!flat.has_area) return;
  detail::rasterize(flat, buffers_->edges);
  if (loop_ == RotatedLoop::kLc) {
    by_lc(flat, box, threads_, buffers_->edges, buffers_->columns, out);
  } else {
    by_looking(flat, box, threads_, buffers_->edges, buffers_->parts, out);
  }
}

void Rotated::rows(const LatticeTriangle& triangle, const Box& clip, RowSink& sink) {
  visits(triangle, clip, buffers_->pixels);
  if (buffers_->pixels.empty()) return;
  const auto [u, v, w] = axes_of(triangle);
  buffers_->set.assign(buffers_->pixels, u, v, w);
  buffers_->set.emit(sink);
}

void Rotated::raster(const LatticeTriangle& triangle, const Box& clip, std::vector<Voxel>& out) {
  visits(triangle, clip, buffers_->pixels);
  out.clear();
  if (buffers_->pixels.empty()) return;
  const auto [u, v, w] = axes_of(triangle);
  buffers_->set.assign(buffers_->pixels, u, v, w, out);
}

}  // namespace footwall::voxelize
