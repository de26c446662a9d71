#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/isosurface/parallel/choose_pillars.h"
#include "engine/isosurface/parallel/collect.h"
#include "engine/isosurface/parallel/weld.h"
#include "engine/service/resident/jobs/surface_stream.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

using isosurface::Bounds;
using isosurface::Point;
using isosurface::Triangle;

constexpr std::size_t kPiece = std::size_t{1} << 16;  // vertices or triangles
constexpr int kTag = 1;

// Rank after rank its share of the elements, piece after piece, on rank 0: one piece is on its way at a time,
// and all ranks agree on it, so that a client that has gone ends it for all.
template <class T, class Give>
void in_order(comm::Communicator& world, std::span<const T> own, const Bounds& bounds, const Give& give) {
  std::vector<T> room;
  for (int rank = 0; rank < world.size(); ++rank) {
    const auto r = static_cast<std::size_t>(rank);
    const std::uint64_t all = bounds[r + 1] - bounds[r];
    for (std::uint64_t first = 0; first < all; first += kPiece) {
      const std::size_t count = std::min<std::uint64_t>(kPiece, all - first);
      const int bytes = static_cast<int>(count * sizeof(T));
      if (rank != 0 && world.rank() == rank) {
        comm::check(MPI_Send(own.data() + first, bytes, MPI_BYTE, 0, kTag, world.get()), "MPI_Send");
      } else if (rank != 0 && world.rank() == 0) {
        room.resize(count);
        comm::check(MPI_Recv(room.data(), bytes, MPI_BYTE, rank, kTag, world.get(), MPI_STATUS_IGNORE),
                    "MPI_Recv");
      }
      world.collectively([&] {
        if (world.rank() == 0) give(rank == 0 ? own.subspan(first, count) : std::span<const T>(room));
      });
    }
  }
}

using Vertex = SentSurface::Vertex;

// More than one view shows.
constexpr std::size_t kKeptSurfaces = 2;

struct Seconds {
  double read = 0;
  double extract = 0;
  double weld = 0;
};

void add(const Point& point, google::protobuf::RepeatedField<float>& to) {
  for (const float each : {point.i, point.j, point.k}) to.Add(each);
}

SentSurface make_surface(comm::Communicator& world, isosurface::StoredSamples& samples,
                         const v1::IsosurfaceRequest& request, int threads, const JobContext& job,
                         Seconds& seconds) {
  const double start = omp_get_wtime();
  // 1. The triangles of each rank's pillars.
  const isosurface::Interleaving cut = world.collectively([&] {
    if (!std::isfinite(request.value())) {
      throw Error(ErrorCode::kUsage, "the value of an isosurface must be a number");
    }
    return isosurface::choose_interleaving(samples.info().dims, world.size(), samples.bricks(),
                                           request.value(), request.normals());
  });
  const isosurface::Pillars pillars(samples.info().dims, world.size(), cut);
  isosurface::ParallelOptions options;
  options.normals = request.normals();
  options.keys = true;
  options.threads = threads;
  options.bricks = &samples.bricks();
  isosurface::Extraction extraction;
  isosurface::extract_parallel(world, pillars, samples.field_of(), request.value(), options, job.part(0, 0.6),
                               extraction);
  const double extracted = omp_get_wtime();

  // 2. One mesh, of which each rank gets an even share, in order.
  world.collectively([&] { job.report(0.6, "weld"); });
  isosurface::MeshPart part = isosurface::weld(world, pillars, request.normals(), extraction.pieces);
  const Bounds vertex_bounds = isosurface::even_bounds(part.all_vertices, world.size());
  const Bounds triangle_bounds = isosurface::even_bounds(part.all_triangles, world.size());
  const std::vector<Vertex> own = world.collectively([&] {
    std::vector<Vertex> vertices(part.own);
    for (std::size_t n = 0; n < part.own; ++n) {
      vertices[n].position = std::as_const(part.mesh.positions)[n];
      if (request.normals()) vertices[n].normal = std::as_const(part.mesh.normals)[n];
    }
    for (Triangle& triangle : part.mesh.triangles.all())
      triangle = {part.numbers[triangle[0]], part.numbers[triangle[1]], part.numbers[triangle[2]]};
    return vertices;
  });
  part.mesh.positions.release();
  part.mesh.normals.release();
  auto vertices = isosurface::collect<Vertex>(world, part.vertex_runs, own, vertex_bounds);
  auto triangles = isosurface::collect<Triangle>(world, part.triangle_runs,
                                                 std::as_const(part.mesh.triangles).all(), triangle_bounds);
  seconds = {extraction.read_seconds, extracted - start, omp_get_wtime() - extracted};
  return {request.value(),    request.normals(),   isosurface::text_of(cut), part.all_vertices,
          part.all_triangles, std::move(vertices), std::move(triangles)};
}

}  // namespace

std::shared_ptr<const SentSurface> SentSurfaces::find(const v1::IsosurfaceRequest& request) const {
  const auto found = std::find_if(surfaces_.begin(), surfaces_.end(), [&](const auto& each) {
    return each->value == request.value() && each->normals == request.normals();
  });
  return found == surfaces_.end() ? nullptr : *found;
}

void SentSurfaces::keep(std::shared_ptr<const SentSurface> surface) {
  surfaces_.remove(surface);
  if (surfaces_.size() == kKeptSurfaces) surfaces_.pop_back();
  surfaces_.push_front(std::move(surface));
}

std::int64_t SentSurfaces::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& each : surfaces_) bytes += each->vertices.room_bytes() + each->triangles.room_bytes();
  return static_cast<std::int64_t>(bytes);
}

void send_isosurface(comm::Communicator& world, isosurface::StoredSamples& samples,
                     const v1::IsosurfaceRequest& request, int threads, const Send& send,
                     const JobContext& job, SentSurfaces* kept) {
  const double start = omp_get_wtime();
  Seconds spent;
  std::shared_ptr<const SentSurface> surface = kept == nullptr ? nullptr : kept->find(request);
  if (!surface)
    surface = std::make_shared<SentSurface>(make_surface(world, samples, request, threads, job, spent));
  const double begun = omp_get_wtime();

  // All of it through rank 0.
  const Bounds vertex_bounds = isosurface::even_bounds(surface->all_vertices, world.size());
  const Bounds triangle_bounds = isosurface::even_bounds(surface->all_triangles, world.size());
  std::uint64_t sent = 0;
  const double all =
      static_cast<double>(std::max<std::uint64_t>(1, surface->all_vertices + surface->all_triangles));
  const auto report = [&](std::size_t more) {
    sent += more;
    job.report(0.75 + 0.25 * static_cast<double>(sent) / all, "send");
  };
  in_order<Vertex>(world, surface->vertices.all(), vertex_bounds, [&](std::span<const Vertex> piece) {
    v1::IsosurfaceReply reply;
    for (const Vertex& each : piece) {
      add(each.position, *reply.mutable_piece()->mutable_positions());
      if (request.normals()) add(each.normal, *reply.mutable_piece()->mutable_normals());
    }
    report(piece.size());
    send(reply);
  });
  in_order<Triangle>(world, surface->triangles.all(), triangle_bounds, [&](std::span<const Triangle> piece) {
    v1::IsosurfaceReply reply;
    for (const Triangle& each : piece) {
      for (const std::uint32_t vertex : each) reply.mutable_piece()->add_triangles(vertex);
    }
    report(piece.size());
    send(reply);
  });

  if (kept != nullptr) kept->keep(surface);

  // What it was.
  nlohmann::json seconds;
  const auto slowest = [&](const char* phase, double mine) { seconds[phase] = world.maximum(mine); };
  slowest("read", spent.read);
  slowest("extract", spent.extract);
  slowest("weld", spent.weld);
  slowest("send", omp_get_wtime() - begun);
  slowest("total", omp_get_wtime() - start);
  world.collectively([&] {
    if (world.rank() != 0) return;
    v1::IsosurfaceReply reply;
    reply.mutable_done()->set_vertices(surface->all_vertices);
    reply.mutable_done()->set_triangles(surface->all_triangles);
    const nlohmann::json json{{"ranks", world.size()},
                              {"threads", threads},
                              {"pillars", surface->cut},
                              {"vertices", surface->all_vertices},
                              {"triangles", surface->all_triangles},
                              {"seconds", seconds}};
    reply.mutable_done()->set_report_json(json.dump());
    send(reply);
  });
}

}  // namespace footwall::service
