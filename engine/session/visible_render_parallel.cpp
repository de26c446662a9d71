#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/render/merge_layers.h"
#include "engine/session/group_options.h"
#include "engine/session/picture_costs.h"
#include "engine/session/visible_render.h"
#include "engine/session/visible_surface.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

class VisibleRender {
 public:
  VisibleRender(comm::Communicator& world, const RenderJob& job, const VolumeOf& volume_of,
                const JobContext& context, const AfterPass& after_pass)
      : world_(world),
        job_(job),
        volume_of_(volume_of),
        context_(context),
        after_pass_(after_pass),
        groups_(group_options(world, job.group_threshold, job.threads)) {}

  void add(std::size_t n);
  render::SurfaceLayer finish(Json& result);

 private:
  std::optional<double> budget_of(std::size_t n) const;

  comm::Communicator& world_;
  const RenderJob& job_;
  const VolumeOf& volume_of_;
  const JobContext& context_;
  const AfterPass& after_pass_;
  render::GroupOptions groups_;
  render::SurfaceLayer layer_;  // of the isosurfaces so far
  int passes_ = 0;
  Json isosurfaces_ = Json::array();
  double read_ = 0;
  double extract_ = 0;
  render::ComposeReport composed_;
};

std::optional<double> VisibleRender::budget_of(std::size_t n) const {
  if (!job_.visible->budget_seconds) return std::nullopt;
  const auto left = static_cast<double>(job_.isosurfaces.size() - n);
  return std::max(0.0, *job_.visible->budget_seconds - extract_) / left;
}

void VisibleRender::add(std::size_t n) {
  const RenderJob::Isosurface& wanted = job_.isosurfaces[n];
  const auto all = static_cast<double>(job_.isosurfaces.size());
  const JobContext part =
      context_.part(0.9 * static_cast<double>(n) / all, 0.9 * static_cast<double>(n + 1) / all);
  isosurface::VisibleRequest request;
  job_.visible->apply_to(request);
  request.isovalue = wanted.value;
  request.placement = wanted.placement;
  request.camera = job_.camera;
  request.colour = wanted.colour;
  request.width = job_.width;
  request.height = job_.height;
  request.threads = job_.threads;
  request.budget_seconds = budget_of(n);
  VisibleSurface::AfterPass after_pass;
  if (after_pass_) {
    after_pass = [&](const render::SurfaceLayer& now) {
      ++passes_;
      if (n == 0) {
        after_pass_(passes_, now);
        return;
      }
      const render::SurfaceLayer both = world_.collectively(
          [&] { return world_.rank() == 0 ? render::nearer_of(layer_, now) : render::SurfaceLayer(); });
      after_pass_(passes_, both);
    };
  }
  DrawnVisible drawn = volume_of_(wanted.volume).visible().draw(world_, request, groups_, part, after_pass);
  read_ += drawn.read_seconds;
  extract_ += drawn.extract_seconds;
  using Seconds = render::ComposeReport::Seconds;
  for (double Seconds::*phase : {&Seconds::group, &Seconds::project, &Seconds::rasterize, &Seconds::shade,
                                 &Seconds::merge, &Seconds::gather})
    composed_.seconds.*phase += drawn.composed.seconds.*phase;
  composed_.bytes += drawn.composed.bytes;
  composed_.messages += drawn.composed.messages;
  composed_.merged_bytes += drawn.composed.merged_bytes;
  composed_.merged_pixels += drawn.composed.merged_pixels;
  world_.collectively([&] {
    if (world_.rank() != 0) return;
    isosurfaces_.push_back(json_of(drawn.report));
    layer_ = n == 0 ? std::move(drawn.layer) : render::nearer_of(layer_, drawn.layer);
  });
}

render::SurfaceLayer VisibleRender::finish(Json& result) {
  result = picture_costs(world_, read_, extract_, composed_);
  result["isosurfaces"] = std::move(isosurfaces_);
  result["mode"] = name_of(job_.visible->mode);
  result["pass_layers"] = passes_;
  return std::move(layer_);
}

}  // namespace

render::SurfaceLayer draw_visible(comm::Communicator& world, const RenderJob& job, const VolumeOf& volume_of,
                                  const JobContext& context, const AfterPass& after_pass, Json& result) {
  VisibleRender render(world, job, volume_of, context, after_pass);
  for (std::size_t n = 0; n < job.isosurfaces.size(); ++n) render.add(n);
  return render.finish(result);
}

}  // namespace footwall::session
