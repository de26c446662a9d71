// Isosurfaces of open volumes.
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/drawn_volume.h"
#include "engine/service/resident/jobs/surface_stream.h"
#include "engine/service/resident/memory_needs.h"

namespace footwall::service {

void isosurface(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const v1::IsosurfaceRequest& request = command.isosurface();
  DrawnKept& there = drawn_volume(state, request.volume());
  if (!there.sent.find(request)) {
    const isosurface::StoredSamples& samples = there.drawn.samples();
    const std::int64_t triangles = expected_triangles(samples.bricks(), request.value());
    const int ranks = state.world.size();
    state.memory.require_free(surface_extraction_bytes(triangles, samples.info().dims, ranks) +
                                  surface_sending_bytes(triangles, ranks),
                              "the isosurface", "close volumes that are not needed, or use more hosts");
  }
  DrawnKept& volume = drawn_volume(state, request.volume());  // what is kept may have been dropped
  send_isosurface(state.world, volume.drawn.samples(), request, state.threads, send, job, &volume.sent);
  volume.drawn.samples().release();
}

}  // namespace footwall::service
