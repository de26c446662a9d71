// A whole isosurface, welded across ranks and sent in pieces.
#pragma once
#include <list>
#include <memory>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/service/engine.pb.h"
#include "engine/service/resident/jobs/send.h"
#include "storage/base/job_context.h"

namespace footwall::service {

// A rank's share of a surface as it is sent, in its order.
struct SentSurface {
  // With its normal, where it is asked for.
  struct Vertex {
    isosurface::Point position;
    isosurface::Point normal;
  };
  float value = 0;
  bool normals = false;
  std::string cut;  // into pillars, in words
  std::uint64_t all_vertices = 0;
  std::uint64_t all_triangles = 0;
  isosurface::PageVector<Vertex> vertices;
  isosurface::PageVector<isosurface::Triangle> triangles;
};

// The last surfaces of a volume that were sent, so that asking again extracts nothing. Alike on every rank.
class SentSurfaces {
 public:
  std::shared_ptr<const SentSurface> find(const v1::IsosurfaceRequest& request) const;
  void keep(std::shared_ptr<const SentSurface> surface);
  std::int64_t memory_bytes() const;  // of this rank

 private:
  std::list<std::shared_ptr<const SentSurface>> surfaces_;  // the last one in front
};

// Collective. Sends SurfacePiece after SurfacePiece, all vertices and then all triangles in the order of the
// surface as one rank would make it, and IsosurfaceDone. Each rank holds its share of the surface, rank 0 one
// piece of another rank besides. Positions are in the volume's own index space. threads: of each rank. kept:
// where the surface is taken from, and goes to when all of it was sent; may be null. Throws on all ranks
// kUsage (a value that is not finite), kUnsupported for 2^32 vertices, kMemory, kCancelled, and what reading
// the volume throws.
void send_isosurface(comm::Communicator& world, isosurface::StoredSamples& samples,
                     const v1::IsosurfaceRequest& request, int threads, const Send& send,
                     const JobContext& job, SentSurfaces* kept = nullptr);

}  // namespace footwall::service
