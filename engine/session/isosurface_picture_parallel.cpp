#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/isosurface/parallel/choose_pillars.h"
#include "engine/render/composite/compose.h"
#include "engine/session/drawn_pieces.h"
#include "engine/session/group_options.h"
#include "engine/session/isosurface_picture.h"
#include "engine/session/picture_costs.h"
#include "engine/session/visible_render.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

// Of each volume: more than one picture shows.
constexpr std::size_t kKeptSurfaces = 4;

render::SurfaceLayer draw_whole(comm::Communicator& world, const RenderJob& job, const VolumeOf& volume_of,
                                const JobContext& context, Json& result) {
  std::vector<std::shared_ptr<const DrawnVolume::Whole>> wholes;  // that are drawn
  DrawnPieces drawn;
  std::uint64_t triangles = 0;
  Json counts = Json::array();
  double read = 0;
  double busy = 0;
  for (std::size_t n = 0; n < job.isosurfaces.size(); ++n) {
    const RenderJob::Isosurface& wanted = job.isosurfaces[n];
    const auto share = static_cast<double>(job.isosurfaces.size());
    const auto at = static_cast<double>(n);
    wholes.push_back(volume_of(wanted.volume)
                         .whole(world, wanted.value, job.interleave, job.threads,
                                context.part(0.7 * at / share, 0.7 * (at + 1) / share)));
    const isosurface::Extraction& extraction = wholes.back()->extraction;
    world.collectively([&] { drawn.add(extraction.pieces, triangles, wanted.colour, wanted.placement); });
    triangles += extraction.triangles;
    counts.push_back({{"triangles", extraction.triangles}});
    read += extraction.read_seconds;
    busy += extraction.busy_seconds;
  }
  world.collectively([&] { context.report(0.75, "draw"); });
  render::ComposeOptions options{job.width, job.height, job.threads, {}};
  options.groups = group_options(world, job.group_threshold, job.threads);
  render::ComposeReport report;
  render::Composer composer;
  render::SurfaceLayer layer =
      composer.compose(world, drawn.surfaces(), job.camera, options, report, context.part(0.75, 0.95));

  result = picture_costs(world, read, busy, report);
  result["isosurfaces"] = std::move(counts);
  return layer;
}

}  // namespace

std::int64_t DrawnVolume::memory_bytes() const {
  std::int64_t bytes = samples_.memory_bytes() + visible_.sample_bytes();
  for (const auto& whole : wholes_) {
    for (const isosurface::Piece& piece : whole->extraction.pieces) {
      const isosurface::Surface& surface = piece.surface;
      bytes += static_cast<std::int64_t>(surface.positions.room_bytes() + surface.normals.room_bytes() +
                                         surface.triangles.room_bytes() + surface.keys.room_bytes());
    }
  }
  return bytes;
}

bool DrawnVolume::has_whole(float value, const std::string& interleave) const {
  return std::any_of(wholes_.begin(), wholes_.end(), [&](const auto& each) {
    return each->value == value && each->interleave == interleave;
  });
}

std::shared_ptr<const DrawnVolume::Whole> DrawnVolume::whole(comm::Communicator& world, float value,
                                                             const std::string& interleave, int threads,
                                                             const JobContext& context) {
  const auto found = std::find_if(wholes_.begin(), wholes_.end(), [&](const auto& each) {
    return each->value == value && each->interleave == interleave;
  });
  if (found != wholes_.end()) {
    (*found)->extraction.read_seconds = 0;
    (*found)->extraction.busy_seconds = 0;
    return *found;
  }
  const auto cut = world.collectively([&] {
    return interleave == "auto" ? isosurface::choose_interleaving(samples_.info().dims, world.size(),
                                                                  samples_.bricks(), value, true)
                                : isosurface::parse_interleaving(interleave);
  });
  const isosurface::Pillars pillars(samples_.info().dims, world.size(), cut);
  isosurface::ParallelOptions options;
  options.threads = threads;
  options.bricks = &samples_.bricks();
  const auto made = std::make_shared<Whole>(Whole{value, interleave, {}});
  isosurface::extract_parallel(world, pillars, samples_.field_of(), value, options, context,
                               made->extraction);
  if (wholes_.size() == kKeptSurfaces) wholes_.pop_back();
  wholes_.push_front(made);
  return wholes_.front();
}

render::SurfaceLayer draw_isosurfaces(comm::Communicator& world, const RenderJob& job,
                                      const VolumeOf& volume_of, const JobContext& context,
                                      const AfterPass& after_pass, Json& result) {
  return job.visible ? draw_visible(world, job, volume_of, context, after_pass, result)
                     : draw_whole(world, job, volume_of, context, result);
}

}  // namespace footwall::session
