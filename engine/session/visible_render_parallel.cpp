#include <omp.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/render/merge_layers.h"
#include "engine/session/group_options.h"
#include "engine/session/visible_render.h"
#include "engine/session/visible_surface.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

class VisibleRender {
 public:
  VisibleRender(comm::Communicator& world, const RenderJob& job, const JobContext& context)
      : world_(world),
        job_(job),
        context_(context),
        groups_(group_options(world, job.group_threshold, job.threads)) {}

  void add(std::size_t n);
  void finish();

 private:
  std::optional<double> budget_of(std::size_t n) const;

  comm::Communicator& world_;
  const RenderJob& job_;
  const JobContext& context_;
  double start_ = omp_get_wtime();
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
  if (!job_.visible->pass_layers.empty()) {
    after_pass = [&](const render::SurfaceLayer& now) {
      ++passes_;
      world_.collectively([&] {
        if (world_.rank() != 0) return;
        const std::filesystem::path file = job_.visible->pass_layer(passes_);
        if (n == 0) {
          now.write(file);
        } else {
          render::nearer_of(layer_, now).write(file);
        }
      });
    };
  }
  isosurface::StoredSamples samples(world_, wanted.volume);
  VisibleSurface surface(samples);
  DrawnVisible drawn = surface.draw(world_, request, groups_, part, after_pass);
  read_ += drawn.read_seconds;
  extract_ += drawn.extract_seconds;
  const auto add_seconds = [&](double render::ComposeReport::Seconds::*phase) {
    composed_.seconds.*phase += drawn.composed.seconds.*phase;
  };
  using Seconds = render::ComposeReport::Seconds;
  for (double Seconds::*phase : {&Seconds::group, &Seconds::project, &Seconds::rasterize, &Seconds::shade,
                                 &Seconds::merge, &Seconds::gather})
    add_seconds(phase);
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

void VisibleRender::finish() {
  Json seconds;
  const auto slowest = [&](const char* phase, double mine) { seconds[phase] = world_.maximum(mine); };
  slowest("read", read_);
  slowest("extract", extract_);
  slowest("group", composed_.seconds.group);
  slowest("project", composed_.seconds.project);
  slowest("rasterize", composed_.seconds.rasterize);
  slowest("shade", composed_.seconds.shade);
  slowest("merge", composed_.seconds.merge);
  slowest("gather", composed_.seconds.gather);
  Json result{{"ranks", world_.size()},
              {"isosurfaces", isosurfaces_},
              {"mode", name_of(job_.visible->mode)},
              {"pass_layers", passes_},
              {"bytes_sent", world_.sum(composed_.bytes)},
              {"messages", world_.sum(composed_.messages)},
              {"merged_bytes", world_.sum(composed_.merged_bytes)},
              {"merged_pixels", world_.sum(composed_.merged_pixels)}};
  world_.collectively([&] {
    context_.report(0.95, "write");
    if (world_.rank() != 0) return;
    layer_.write(job_.layer);
    seconds["total"] = omp_get_wtime() - start_;
    result["seconds"] = seconds;
    result["layer_bytes"] = layer_.bytes();
    write_whole_file(job_.result, result.dump(1) + "\n");
  });
}

}  // namespace

void run_visible_render(comm::Communicator& world, const RenderJob& job, const JobContext& context) {
  VisibleRender render(world, job, context);
  for (std::size_t n = 0; n < job.isosurfaces.size(); ++n) render.add(n);
  render.finish();
}

}  // namespace footwall::session
