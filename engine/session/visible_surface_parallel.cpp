#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/session/host_ranks.h"
#include "engine/session/visible_surface.h"
#include "storage/base/error.h"
#include "storage/base/usable_memory.h"

namespace footwall::session {
namespace {

using isosurface::VisiblePieces;
using isosurface::VisibleRequest;

// bytes: of each rank.
void check_memory(std::int64_t bytes, int ranks_here, const char* what, const char* hint) {
  const std::int64_t usable = usable_memory().bytes;
  if (bytes <= usable / ranks_here) return;
  throw Error(ErrorCode::kMemory,
              fmt::format("{}: {} MiB for {} ranks, and {} MiB are free", what, bytes * ranks_here >> 20,
                          ranks_here, usable >> 20),
              hint);
}

// More than one picture shows.
constexpr std::size_t kKeptPictures = 4;

}  // namespace

VisibleSurface::Picture& VisibleSurface::picture_of(float isovalue) {
  const auto found = std::find_if(pictures_.begin(), pictures_.end(),
                                  [&](const Picture& each) { return each.isovalue == isovalue; });
  if (found != pictures_.end()) {
    pictures_.splice(pictures_.begin(), pictures_, found);
  } else {
    if (pictures_.size() == kKeptPictures) pictures_.pop_back();
    pictures_.emplace_front();
    pictures_.front().isovalue = isovalue;
  }
  return pictures_.front();
}

DrawnVisible VisibleSurface::draw(comm::Communicator& world, VisibleRequest request,
                                  const render::GroupOptions& groups, const JobContext& context,
                                  const AfterPass& after_pass) {
  request.volume_size = samples_.info().dims;
  request.bricks = samples_.bricks();
  DrawnVisible drawn;
  switch (request.mode) {
    case isosurface::VisibleMode::kPaper:
      draw_paper(world, request, groups, context, after_pass, drawn);
      break;
    case isosurface::VisibleMode::kDepth:
      draw_depth(world, request, context, after_pass, drawn);
      break;
  }
  return drawn;
}

void VisibleSurface::draw_depth(comm::Communicator& world, const VisibleRequest& request,
                                const JobContext& context, const AfterPass& after_pass, DrawnVisible& drawn) {
  // 1. Each rank reads its own part, and draws a whole picture.
  const double start = omp_get_wtime();
  const int ranks_here = ranks_of_this_host(world);
  world.collectively([&] {
    const std::int64_t pixels = std::int64_t{request.width} * request.height;
    check_memory(pixels * static_cast<std::int64_t>(sizeof(render::Visible) + sizeof(render::Rgba)),
                 ranks_here, "what can be seen needs a whole picture on every rank",
                 "give a smaller --size or fewer --ranks, or leave --visible out");
    context.report(0, "read");
    surfaces_.clear();  // of a picture that may go
    if (!pillars_) {
      pillars_.emplace(samples_.field_of(), request.volume_size, world.size(), world.rank(),
                       isosurface::kVisibleInterleaving);
    }
    context.report(0.5, "passes");
  });
  drawn.read_seconds = omp_get_wtime() - start;

  // 2. Waves, drawn and merged.
  const double began = omp_get_wtime();
  isosurface::VisiblePicture::AfterWave tell;
  if (after_pass) tell = [&](int, const render::SurfaceLayer& layer) { after_pass(layer); };
  isosurface::VisiblePicture& picture = picture_of(request.isovalue).drawn;
  try {
    drawn.layer =
        picture.draw(world, pillars_->parts(), request, drawn.report, drawn.composed, tell, context);
  } catch (...) {
    picture.forget();  // what it showed is half of a picture
    throw;
  }
  const render::ComposeReport::Seconds& composed = drawn.composed.seconds;
  drawn.extract_seconds =
      omp_get_wtime() - began - picture.aside_seconds() - composed.shade - composed.merge - composed.gather;
  world.collectively([&] {
    context.check();
    const auto surfaces = picture.drawing().frame().surfaces();
    surfaces_.assign(surfaces.begin(), surfaces.end());
  });
}

void VisibleSurface::draw_paper(comm::Communicator& world, const VisibleRequest& request,
                                const render::GroupOptions& groups, const JobContext& context,
                                const AfterPass& after_pass, DrawnVisible& drawn) {
  // 1. Every rank has the whole volume, as was published.
  const double start = omp_get_wtime();
  const survey::Box all{{0, 0, 0}, samples_.info().dims};
  const int ranks_here = ranks_of_this_host(world);
  const isosurface::Field volume = world.collectively([&] {
    check_memory(all.count() * static_cast<std::int64_t>(sizeof(float)), ranks_here,
                 "mode paper needs the whole volume on every rank", "use --mode depth, or fewer --ranks");
    return samples_.read(all);
  });
  const std::optional<isosurface::Octree> octree = world.collectively([&] {
    std::optional<isosurface::Octree> made;
    if (world.rank() != 0) return made;
    survey::Index cell = isosurface::default_paper_cell(request.volume_size);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (request.cell[axis] > 0) cell[axis] = request.cell[axis];
    }
    made.emplace(isosurface::paper_octree(volume, request.bricks, cell, request.threads));
    return made;
  });
  const double read = omp_get_wtime();
  drawn.read_seconds = read - start;

  // 2. Passes; pictures of what there is after each, where they are wanted.
  render::Composer composer;
  const render::ComposeOptions options{request.width, request.height, request.threads, groups};
  const auto compose = [&](const VisiblePieces& pieces, render::ComposeReport& report) {
    world.collectively([&] {
      surfaces_.clear();
      for (const isosurface::SomeTriangles& some : pieces.passes)
        surfaces_.push_back(isosurface::lit(some, request.colour, request.placement));
    });
    return composer.compose(world, surfaces_, request.camera, options, report);
  };
  double aside = 0;
  std::function<void(const VisiblePieces&)> tell;
  if (after_pass) {
    tell = [&](const VisiblePieces& pieces) {
      const double began = omp_get_wtime();
      render::ComposeReport report;
      after_pass(compose(pieces, report));
      aside += omp_get_wtime() - began;
    };
  }
  isosurface::extract_visible_paper(world, volume, octree ? &*octree : nullptr, request, context, tell,
                                    pieces_);
  drawn.extract_seconds = omp_get_wtime() - read - aside;

  // 3. The picture.
  drawn.layer = compose(pieces_, drawn.composed);
  drawn.report = std::exchange(pieces_.report, {});
}

}  // namespace footwall::session
