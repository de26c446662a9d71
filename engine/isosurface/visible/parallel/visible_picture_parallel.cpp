#include "engine/isosurface/visible/parallel/visible_picture_parallel.h"

#include "storage/base/stopwatch.h"

namespace footwall::isosurface {

render::SurfaceLayer VisiblePicture::draw(comm::Communicator& world, std::span<const VolumePart> parts,
                                          const VisibleRequest& request, VisibleReport& report,
                                          render::ComposeReport& composed, const AfterWave& after_wave,
                                          const JobContext& job) {
  WorldRanks ranks(world, job);
  aside_seconds_ = 0;
  const render::ComposeOptions options{request.width, request.height, request.threads, {}};
  std::function<void(int)> tell;
  if (after_wave) {
    tell = [&](int wave) {
      const Stopwatch time(aside_seconds_);
      // Merging changes the window, which the next wave goes on with.
      world.collectively([&] { drawing_.frame().number(); });
      render::VisibilityBuffer window = world.collectively([&] { return drawing_.window(); });
      render::ComposeReport unused;
      after_wave(wave, composer_.compose_drawn(world, drawing_.frame(), window, options, unused));
    };
  }
  report = drawing_.draw(ranks, parts, request, tell);
  return composer_.compose_drawn(world, drawing_.frame(), drawing_.window(), options, composed);
}

}  // namespace footwall::isosurface
