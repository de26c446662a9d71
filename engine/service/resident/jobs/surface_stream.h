// A whole isosurface, welded across ranks and sent in pieces.
#pragma once
#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/service/engine.pb.h"
#include "engine/service/resident/jobs/send.h"
#include "storage/base/job_context.h"

namespace footwall::service {

// Collective. Sends SurfacePiece after SurfacePiece, all vertices and then all triangles in the order of the
// surface as one rank would make it, and IsosurfaceDone. Each rank holds its share of the surface, rank 0 one
// piece of another rank besides. Positions are in the volume's own index space. threads: of each rank. Throws
// on all ranks kUsage (a value that is not finite), kUnsupported for 2^32 vertices, kMemory, kCancelled, and
// what reading the volume throws.
void send_isosurface(comm::Communicator& world, isosurface::StoredSamples& samples,
                     const v1::IsosurfaceRequest& request, int threads, const Send& send,
                     const JobContext& job);

}  // namespace footwall::service
